// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "core/base/result.h"
#include "render/gl/handle.h"
#include "render/gl/shader_source.h"

namespace ego::gl {

/// A linked vertex and fragment shader.
class Program {
 public:
  Program() = default;

  /// Both stages from shaders/. The error's sentence begins with the shader's file and line.
  static Result<Program> Build(std::string_view vertex, std::string_view fragment,
                               std::span<const std::string_view> defines = {},
                               std::span<const ShaderFile> files = ShaderFiles());

  void Use() const { glUseProgram(handle_.Name()); }
  /// Sets a uniform of the program in use; one that the compiler removed is ignored.
  void Set(const char* name, int value) const;
  void Set(const char* name, float value) const;
  void Set(const char* name, const glm::vec2& value) const;
  void Set(const char* name, const glm::vec3& value) const;
  void Set(const char* name, const glm::vec4& value) const;
  void Set(const char* name, const glm::mat4& value) const;

 private:
  GLint Location(const char* name) const { return glGetUniformLocation(handle_.Name(), name); }
  Handle<ProgramKind> handle_;
};

}  // namespace ego::gl
