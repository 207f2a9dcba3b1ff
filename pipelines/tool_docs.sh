#!/usr/bin/env bash
# Writes FOLDER/TOOL.md from each tool's --help: tool_docs.sh BIN FOLDER TOOL...
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1 folder=$2
shift 2
mkdir -p "$folder"
for tool in "$@"; do
    { printf '# %s\n\nMade from `%s --help` by `make docs`.\n\n```text\n' "$tool" "$tool"
      "$bin/$tool" --help
      printf '```\n'; } >"$folder/$tool.md"
done
