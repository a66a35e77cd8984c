// SPDX-License-Identifier: MIT
#include <array>

#include <gtest/gtest.h>

#include "render/gl/program.h"
#include "render/offscreen.h"

namespace ego::gl {
namespace {

const std::array<ShaderFile, 4> kFiles = {{
    {"good.vert", "void main() { gl_Position = vec4(0.0); }\n"},
    {"shared.glsl", "float One() { return 1.0; }\nfloat Two() { return banana; }\n"},
    {"bad.frag", "out vec4 pixel;\n#include \"shared.glsl\"\n\nvoid main() { pixel = apple; }\n"},
    {"lost.frag", "\n\n#include \"nowhere.glsl\"\n"},
}};

TEST(Shader, EveryFileIsInTheProgram) {
  EXPECT_GE(ShaderFiles().size(), 10u);
  for (const ShaderFile& file : ShaderFiles()) EXPECT_FALSE(file.text.empty()) << file.name;
}

TEST(Shader, AMissingFileIsNamed) {
  const Result<ShaderSource> none = LoadShader("none.frag", {}, kFiles);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().find("shaders/none.frag"), std::string::npos);
  const Result<ShaderSource> lost = LoadShader("lost.frag", {}, kFiles);
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error(), "shaders/lost.frag:3: cannot include \"nowhere.glsl\".");
}

TEST(Shader, AFileThatIncludesItselfIsRefused) {
  const std::array<ShaderFile, 1> files = {{{"a.frag", "#include \"a.frag\"\n"}}};
  EXPECT_FALSE(LoadShader("a.frag", {}, files));
}

TEST(Shader, TheCompilersMessagesAreLedBackToTheFile) {
  const Result<ShaderSource> source = LoadShader("bad.frag", {}, kFiles);
  ASSERT_TRUE(source);
  // What is compiled: #version, then bad.frag with the two lines of shared.glsl in place of its
  // second.
  EXPECT_EQ(ReadableLog("0:6(23): error: `apple' undeclared\n", *source),
            "shaders/bad.frag:4: error: `apple' undeclared");
  EXPECT_EQ(ReadableLog("0(4) : error C1503: undefined variable \"banana\"", *source),
            "shaders/shared.glsl:2: error C1503: undefined variable \"banana\"");
  EXPECT_EQ(ReadableLog("0:1(1): error", *source), "0:1(1): error");
  EXPECT_EQ(ReadableLog("0:99(1): error", *source), "0:99(1): error");
  EXPECT_EQ(ReadableLog("out of memory", *source), "out of memory");
}

TEST(Shader, ACompileErrorNamesFileAndLine) {
  Result<OffscreenContext> context = OffscreenContext::Create();
  if (!context) GTEST_SKIP() << context.error();
  const Result<Program> bad = Program::Build("good.vert", "bad.frag", {}, kFiles);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().rfind("shaders/shared.glsl:2:", 0), 0u) << bad.error();
  EXPECT_NE(bad.error().find("shaders/bad.frag:4:"), std::string::npos) << bad.error();
}

TEST(Shader, DefinesAreSeenByTheShader) {
  Result<OffscreenContext> context = OffscreenContext::Create();
  if (!context) GTEST_SKIP() << context.error();
  const std::array<ShaderFile, 2> files = {{
      kFiles[0],
      {"a.frag", "out vec4 p;\n#ifdef RED\nvoid main() { p = vec4(1.0); }\n#endif\n"},
  }};
  constexpr std::array<std::string_view, 1> kRed = {"RED"};
  EXPECT_TRUE(Program::Build("good.vert", "a.frag", kRed, files));
  EXPECT_FALSE(Program::Build("good.vert", "a.frag", {}, files));
}

}  // namespace
}  // namespace ego::gl
