# cmake -DOUTPUT=... -DNAME=... -DFILES=a.json;b.json -P TextHeader.cmake: a header that holds the files
# as texts, in namespace NAME, each under its name without the ending.
set(text "#pragma once\n\nnamespace ${NAME} {\n")
foreach(file IN LISTS FILES)
  get_filename_component(stem ${file} NAME_WE)
  file(READ ${file} content)
  string(APPEND text "\ninline constexpr const char* ${stem} = R\"text(${content})text\";\n")
endforeach()
string(APPEND text "\n}  // namespace ${NAME}\n")
file(WRITE ${OUTPUT} "${text}")
