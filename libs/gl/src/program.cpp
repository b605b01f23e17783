#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/gl/program.h>

namespace ssphh::gl {
namespace {

/// One shader with its includes in place.
struct Source {
  struct Place {
    std::string file;
    int line;
  };
  std::string text;
  std::vector<Place> places;  ///< of each line of `text`
  std::set<std::string> included;

  void add_line(const std::string& line, const std::string& file, int number) {
    text += line + "\n";
    places.push_back({file, number});
  }
};

void append_file(const ShaderFiles& files, const std::string& name, std::string_view defines, Source& out) {
  if (!out.included.insert(name).second) return;
  std::istringstream lines(files.text(name));
  std::string line;
  for (int n = 1; std::getline(lines, line); ++n) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line.compare(first, 8, "#include") == 0) {
      const std::size_t open = line.find('"'), close = line.rfind('"');
      if (open == close)
        throw Error(fmt::format("{}:{}", name, n), "#include needs a name in quotation marks");
      append_file(files, line.substr(open + 1, close - open - 1), {}, out);
      continue;
    }
    out.add_line(line, name, n);
    if (line.compare(0, 8, "#version") != 0) continue;
    std::istringstream extra{std::string(defines)};
    for (std::string define; std::getline(extra, define);) out.add_line(define, name, n);
  }
}

/// Compilers name lines of the whole text: "0:12(3): ..." (Mesa), "0(12) : ..." (NVIDIA), "ERROR: 0:12: ..."
/// (others). `#line` would not do: Mesa forgets its file number inside expressions.
std::string with_file_names(const std::string& log, const Source& source) {
  static const std::regex place(R"(^(ERROR: |WARNING: )?\d+(:|\()(\d+)(\(\d+\))?\)? ?)");
  std::istringstream lines(log);
  std::string line, out;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_search(line, match, place)) {
      const std::size_t number = std::stoul(match[3]);
      if (number >= 1 && number <= source.places.size()) {
        const Source::Place& at = source.places[number - 1];
        line = fmt::format("{}:{}{}", at.file, at.line, match.suffix().str());
      }
    }
    if (!line.empty() && line.find_first_not_of('\0') != std::string::npos)
      out += (out.empty() ? "" : "\n") + line;
  }
  return out;
}

template <class GetLength, class GetLog>
std::string info_log(unsigned id, GetLength get_length, GetLog get_log) {
  GLint length = 0;
  get_length(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
  if (length > 0) get_log(id, length, nullptr, log.data());
  log.resize(std::min(log.size(), log.find('\0')));
  return log;
}

class Shader {
 public:
  Shader(GLenum type, const ShaderFiles& files, const std::string& name, std::string_view defines,
         std::string& warnings)
      : id_(glCreateShader(type)) {
    Source source;
    append_file(files, name, defines, source);
    const char* text = source.text.c_str();
    glShaderSource(id_, 1, &text, nullptr);
    glCompileShader(id_);
    GLint ok = 0;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &ok);
    const std::string log = with_file_names(
        info_log(
            id_, [](auto... a) { glGetShaderiv(a...); }, [](auto... a) { glGetShaderInfoLog(a...); }),
        source);
    if (!ok) {
      glDeleteShader(id_);
      throw Error("shader " + name, log.empty() ? "does not compile" : log);
    }
    if (!log.empty()) warnings += (warnings.empty() ? "" : "\n") + log;
  }
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  unsigned id() const { return id_; }

 private:
  unsigned id_;
};

void link(unsigned id, const std::string& name, std::string& warnings) {
  glLinkProgram(id);
  GLint ok = 0;
  glGetProgramiv(id, GL_LINK_STATUS, &ok);
  const std::string log = info_log(
      id, [](auto... a) { glGetProgramiv(a...); }, [](auto... a) { glGetProgramInfoLog(a...); });
  if (!ok) throw Error("shader program " + name, log.empty() ? "does not link" : log);
  if (!log.empty()) warnings += (warnings.empty() ? "" : "\n") + log;
}

}  // namespace

void delete_program(unsigned id) {
  glDeleteProgram(id);
}

ShaderFiles::ShaderFiles(std::span<const Embedded> embedded, std::filesystem::path directory)
    : directory_(std::move(directory)) {
  for (const Embedded& file : embedded) embedded_.emplace(file.name, file.text);
}

std::string ShaderFiles::text(const std::string& name) const {
  if (!directory_.empty() && std::filesystem::exists(directory_ / name))
    return read_text_file(directory_ / name);
  const auto found = embedded_.find(name);
  if (found == embedded_.end()) throw Error("shader " + name, "there is no such file");
  return std::string(found->second);
}

std::filesystem::file_time_type ShaderFiles::newest_change() const {
  auto newest = std::filesystem::file_time_type::min();
  if (directory_.empty()) return newest;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory_, ignored))
    newest = std::max(newest, entry.last_write_time(ignored));
  return newest;
}

Program::Program(const ShaderFiles& files, const std::string& vertex, const std::string& fragment,
                 std::string_view defines) {
  const Shader v(GL_VERTEX_SHADER, files, vertex, defines, warnings_);
  const Shader f(GL_FRAGMENT_SHADER, files, fragment, defines, warnings_);
  handle_ = Handle<delete_program>(glCreateProgram());
  glAttachShader(id(), v.id());
  glAttachShader(id(), f.id());
  link(id(), vertex + " + " + fragment, warnings_);
}

Program Program::compute(const ShaderFiles& files, const std::string& name, std::string_view defines) {
  Program program;
  const Shader shader(GL_COMPUTE_SHADER, files, name, defines, program.warnings_);
  program.handle_ = Handle<delete_program>(glCreateProgram());
  glAttachShader(program.id(), shader.id());
  link(program.id(), name, program.warnings_);
  return program;
}

void Program::use() const {
  glUseProgram(id());
}

int Program::location(const char* name) {
  for (const auto& [known, place] : locations_) {
    if (known == name) return place;
  }
  locations_.emplace_back(name, glGetUniformLocation(id(), name));
  return locations_.back().second;
}

void Program::set(const char* name, int value) {
  glProgramUniform1i(id(), location(name), value);
}
void Program::set(const char* name, int x, int y, int z, int w) {
  glProgramUniform4i(id(), location(name), x, y, z, w);
}
void Program::set(const char* name, std::span<const float> values) {
  glProgramUniform1fv(id(), location(name), static_cast<GLsizei>(values.size()), values.data());
}
void Program::set_at(int place, int value) {
  glProgramUniform1i(id(), place, value);
}
void Program::set(const char* name, float value) {
  glProgramUniform1f(id(), location(name), value);
}
void Program::set(const char* name, const vec2& value) {
  glProgramUniform2fv(id(), location(name), 1, &value.x);
}
void Program::set(const char* name, const vec3& value) {
  glProgramUniform3fv(id(), location(name), 1, &value.x);
}
void Program::set(const char* name, const vec4& value) {
  glProgramUniform4fv(id(), location(name), 1, &value.x);
}
void Program::set(const char* name, const mat4& value) {
  glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, &value[0].x);
}

}  // namespace ssphh::gl
