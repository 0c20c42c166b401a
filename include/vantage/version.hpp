// SPDX-License-Identifier: MIT
#pragma once

/// \file
/// Version of this library for the preprocessor: `#if VANTAGE_VERSION >= VANTAGE_VERSION_NUMBER(0, 2, 0)`.

// NOLINTBEGIN(cppcoreguidelines-macro-usage): #if can only compare macros.

/// A version as one number that sorts like the version. Each part must be below 1000.
#define VANTAGE_VERSION_NUMBER(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))

/// Major part of the version.
#define VANTAGE_VERSION_MAJOR 0
/// Minor part of the version.
#define VANTAGE_VERSION_MINOR 1
/// Patch part of the version.
#define VANTAGE_VERSION_PATCH 0
/// The version as a string literal, "major.minor.patch".
#define VANTAGE_VERSION_STRING "0.1.0"
/// The version as a number, comparable with VANTAGE_VERSION_NUMBER.
#define VANTAGE_VERSION VANTAGE_VERSION_NUMBER(VANTAGE_VERSION_MAJOR, VANTAGE_VERSION_MINOR, VANTAGE_VERSION_PATCH)

// NOLINTEND(cppcoreguidelines-macro-usage)
