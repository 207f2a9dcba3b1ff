#!/usr/bin/env bash
# Writes FOLDER/TOOL.md from each tool's --help, or --help-all where it has that: tool_docs.sh BIN FOLDER TOOL...
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1 folder=$2
shift 2
mkdir -p "$folder"
for tool in "$@"; do
    help=--help
    "$bin/$tool" --help | grep -q -e --help-all && help=--help-all
    { printf '# %s\n\nMade from `%s %s` by `make docs`.\n\n```text\n' "$tool" "$tool" $help
      "$bin/$tool" $help
      printf '```\n'; } >"$folder/$tool.md"
done
