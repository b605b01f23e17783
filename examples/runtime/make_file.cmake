# Bakes and cooks a built-in box whose walls emit 1 and reflect half: cmake -DTOOL=... -DOUTPUT=NAME.sphlc -P make_file.cmake
foreach(command "bake;builtin:box;-o;${OUTPUT}.sphl;--quality;draft;--records;0" "cook;${OUTPUT}.sphl;--scene;builtin:box;-o;${OUTPUT}")
  execute_process(COMMAND ${TOOL} ${command} --progress none OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
