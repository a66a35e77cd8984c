// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <epoxy/gl.h>

namespace ego::gl {

/// Owns one OpenGL name and deletes it; zero is none. Needs the context current at the end.
template <class Kind>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0u)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      Reset();
      name_ = std::exchange(other.name_, 0u);
    }
    return *this;
  }
  ~Handle() { Reset(); }

  static Handle Make() { return Handle(Kind::Create()); }
  GLuint Name() const { return name_; }
  explicit operator bool() const { return name_ != 0u; }

 private:
  void Reset() {
    if (name_ != 0u) Kind::Delete(name_);
    name_ = 0u;
  }
  GLuint name_ = 0u;
};

struct BufferKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenTextures(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteTextures(1, &name); }
};
struct FramebufferKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct RenderbufferKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct ShaderKind {
  static void Delete(GLuint name) { glDeleteShader(name); }
};
struct ProgramKind {
  static GLuint Create() { return glCreateProgram(); }
  static void Delete(GLuint name) { glDeleteProgram(name); }
};

using Buffer = Handle<BufferKind>;
using VertexArray = Handle<VertexArrayKind>;
using Texture = Handle<TextureKind>;
using Framebuffer = Handle<FramebufferKind>;
using Renderbuffer = Handle<RenderbufferKind>;
using Shader = Handle<ShaderKind>;

}  // namespace ego::gl
