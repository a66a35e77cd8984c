// SPDX-License-Identifier: MIT
#include "render/gl/program.h"

#include <glm/gtc/type_ptr.hpp>

namespace ego::gl {
namespace {

template <class GetLength, class GetText>
std::string Log(GLuint name, GetLength get_length, GetText get_text) {
  GLint length = 0;
  get_length(name, GL_INFO_LOG_LENGTH, &length);
  if (length <= 0) return "no message";
  std::string log(static_cast<std::size_t>(length), '\0');
  GLsizei written = 0;
  get_text(name, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

Result<Shader> Compile(GLenum stage, std::string_view name,
                       std::span<const std::string_view> defines,
                       std::span<const ShaderFile> files) {
  Result<ShaderSource> source = LoadShader(name, defines, files);
  if (!source) return Error{source.error()};
  Shader shader(glCreateShader(stage));
  const char* text = source->text.c_str();
  glShaderSource(shader.Name(), 1, &text, nullptr);
  glCompileShader(shader.Name());
  GLint ok = GL_FALSE;
  glGetShaderiv(shader.Name(), GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  const std::string log = ReadableLog(Log(
                                          shader.Name(), [](auto... a) { glGetShaderiv(a...); },
                                          [](auto... a) { glGetShaderInfoLog(a...); }),
                                      *source);
  // Most drivers lead with the place; those that do not are told apart by the stage's name.
  return Error{log.starts_with("shaders/") ? log : "shaders/" + std::string(name) + ": " + log};
}

}  // namespace

Result<Program> Program::Build(std::string_view vertex, std::string_view fragment,
                               std::span<const std::string_view> defines,
                               std::span<const ShaderFile> files) {
  Result<Shader> vertex_shader = Compile(GL_VERTEX_SHADER, vertex, defines, files);
  if (!vertex_shader) return Error{vertex_shader.error()};
  Result<Shader> fragment_shader = Compile(GL_FRAGMENT_SHADER, fragment, defines, files);
  if (!fragment_shader) return Error{fragment_shader.error()};

  Program program;
  program.handle_ = Handle<ProgramKind>::Make();
  const GLuint name = program.handle_.Name();
  glAttachShader(name, vertex_shader->Name());
  glAttachShader(name, fragment_shader->Name());
  glLinkProgram(name);
  glDetachShader(name, vertex_shader->Name());
  glDetachShader(name, fragment_shader->Name());
  GLint ok = GL_FALSE;
  glGetProgramiv(name, GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return program;
  return Error{"shaders/" + std::string(vertex) + " with shaders/" + std::string(fragment) + ": " +
               Log(
                   name, [](auto... a) { glGetProgramiv(a...); },
                   [](auto... a) { glGetProgramInfoLog(a...); })};
}

void Program::Set(const char* name, int value) const { glUniform1i(Location(name), value); }
void Program::Set(const char* name, float value) const { glUniform1f(Location(name), value); }
void Program::Set(const char* name, const glm::vec2& value) const {
  glUniform2fv(Location(name), 1, glm::value_ptr(value));
}
void Program::Set(const char* name, const glm::vec3& value) const {
  glUniform3fv(Location(name), 1, glm::value_ptr(value));
}
void Program::Set(const char* name, const glm::vec4& value) const {
  glUniform4fv(Location(name), 1, glm::value_ptr(value));
}
void Program::Set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(Location(name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace ego::gl
