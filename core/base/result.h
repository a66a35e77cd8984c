// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace ego {

/// What went wrong, as one sentence for a person: it names the file (or device), the object in it
/// and what was expected. No trailing newline.
struct Error {
  std::string message;
};

/// A value, or the sentence that says why there is none. Used for everything that comes from
/// outside (files, devices, hand-written JSON); mistakes of the programmer are asserted instead.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}             // NOLINT: conversion is the purpose
  Result(Error error) : error_(std::move(error.message)) {}  // NOLINT: conversion is the purpose

  explicit operator bool() const { return value_.has_value(); }
  T& operator*() & { return *value_; }
  const T& operator*() const& { return *value_; }
  T&& operator*() && { return *std::move(value_); }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }

  /// The sentence; empty when there is a value.
  const std::string& error() const { return error_; }

 private:
  std::optional<T> value_;
  std::string error_;
};

/// Success, or the sentence that says why not.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : failed_(true), error_(std::move(error.message)) {}  // NOLINT

  explicit operator bool() const { return !failed_; }
  const std::string& error() const { return error_; }

 private:
  bool failed_ = false;
  std::string error_;
};

}  // namespace ego
