// Nothing: the target it belongs to holds the tools' precompiled header.
// SPDX-License-Identifier: GPL-3.0-or-later
