# cmake -DOUTPUT=... -DNAME=... -DFILES=a.json;b.json -P TextHeader.cmake: a header that holds the files
# as texts, in namespace NAME, each under its name without the ending. With -DDIGESTS=ON also their SHA-256,
# as NAME_sha256.
set(text "#pragma once\n\nnamespace ${NAME} {\n")
foreach(file IN LISTS FILES)
  get_filename_component(stem ${file} NAME_WE)
  file(READ ${file} content)
  string(APPEND text "\ninline constexpr const char* ${stem} = R\"text(${content})text\";\n")
  if(DIGESTS)
    string(SHA256 digest "${content}")
    string(APPEND text "inline constexpr const char* ${stem}_sha256 = \"${digest}\";\n")
  endif()
endforeach()
string(APPEND text "\n}  // namespace ${NAME}\n")
file(WRITE ${OUTPUT} "${text}")
