// Nothing: the target it belongs to holds the tests' precompiled headers.
// SPDX-License-Identifier: GPL-3.0-or-later
