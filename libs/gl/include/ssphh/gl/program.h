#pragma once
/// Shader programs from GLSL files that include each other.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/gl/handle.h>

namespace ssphh::gl {

/// Shader sources by name ("gbuffer.frag"): those built in, or the files of a directory, which win.
class ShaderFiles {
 public:
  struct Embedded {
    std::string_view name, text;
  };
  explicit ShaderFiles(std::span<const Embedded> embedded, std::filesystem::path directory = {});

  /// Throws Error for an unknown name.
  std::string text(const std::string& name) const;
  /// Newest change in the directory; the least value without one.
  std::filesystem::file_time_type newest_change() const;
  bool on_disk() const { return !directory_.empty(); }

 private:
  std::map<std::string, std::string_view, std::less<>> embedded_;
  std::filesystem::path directory_;
};

/// A linked vertex and fragment shader, or a compute shader.
class Program {
 public:
  Program() = default;
  /// `#include "name"` is replaced by that file, once per shader. `defines` are lines put after `#version`.
  /// Throws Error whose message names file and line as the author knows them.
  Program(const ShaderFiles& files, const std::string& vertex, const std::string& fragment,
          std::string_view defines = {});
  static Program compute(const ShaderFiles& files, const std::string& name, std::string_view defines = {});

  unsigned id() const { return handle_.get(); }
  /// What the compiler said beside errors; empty: nothing.
  const std::string& warnings() const { return warnings_; }

  void use() const;
  /// Uniforms by name, of the program itself, in use or not. Names that the shader lacks are ignored: the
  /// compiler removes what a variant does not need.
  void set(const char* name, int value);
  void set(const char* name, int x, int y, int z = 0, int w = 0);
  void set(const char* name, float value);
  void set(const char* name, const vec2& value);
  void set(const char* name, const vec3& value);
  void set(const char* name, const vec4& value);
  void set(const char* name, const mat4& value);
  void set(const char* name, std::span<const float> values);
  /// By the location that the shader gives it.
  void set_at(int location, int value);

 private:
  int location(const char* name);
  Handle<delete_program> handle_;
  std::string warnings_;
  std::vector<std::pair<std::string, int>> locations_;
};

}  // namespace ssphh::gl
