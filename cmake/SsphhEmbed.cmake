# Writes text FILES into the C++ file OUTPUT as a table of (name, text): cmake -DOUTPUT=... -DFILES=a;b -P this.
set(code "#include \"shader_table.h\"\n\nnamespace ssphh::realtime {\n\nstd::span<const gl::ShaderFiles::Embedded> shader_table() {\n  static const gl::ShaderFiles::Embedded table[] = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND code "    {\"${name}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
string(APPEND code "  };\n  return table;\n}\n\n}  // namespace ssphh::realtime\n")
file(WRITE ${OUTPUT} "${code}")
