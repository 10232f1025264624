# glibc chooses its sin, exp and kin by the CPU it finds; they differ in the last bit, and traffic is
# chaotic. So programs that simulate carry musl's, as one object in the executable: the dynamic
# linker then binds Bullet, SUMO and Lua to it as well. docs/determinism.md says more. Not fmod: it
# is exact, so equal everywhere, and scripting/lua/charged.cpp has one that scripts pay for.
find_file(MUSL_LIBC libc.a PATHS /usr/lib/x86_64-linux-musl NO_DEFAULT_PATH REQUIRED)
include(PortableFunctions)
list(TRANSFORM portable_functions PREPEND "--undefined=" OUTPUT_VARIABLE wanted)
list(TRANSFORM portable_functions PREPEND "--keep-global-symbol=" OUTPUT_VARIABLE kept)

set(portable_math_object ${PROJECT_BINARY_DIR}/generated/portable_math.o)
add_custom_command(
  OUTPUT ${portable_math_object}
  COMMAND ${CMAKE_LINKER} -r -o ${portable_math_object}.all ${wanted} ${MUSL_LIBC}
  COMMAND ${CMAKE_OBJCOPY} ${kept} ${portable_math_object}.all ${portable_math_object}
  DEPENDS ${MUSL_LIBC} VERBATIM)
# The same code, whose pow gives way to one that scripts pay for, and has a second name for it.
set(portable_math_linked ${PROJECT_BINARY_DIR}/generated/portable_math_linked.o)
add_custom_command(
  OUTPUT ${portable_math_linked}
  COMMAND ${CMAKE_LINKER} -r -o ${portable_math_linked}.all --defsym=portable_pow=pow ${portable_math_object}
  COMMAND ${CMAKE_OBJCOPY} --weaken-symbol=pow ${portable_math_linked}.all ${portable_math_linked}
  DEPENDS ${portable_math_object} VERBATIM)
add_custom_target(portable_math_object DEPENDS ${portable_math_object} ${portable_math_linked})
add_library(portable_math OBJECT IMPORTED GLOBAL)
set_target_properties(portable_math PROPERTIES IMPORTED_OBJECTS ${portable_math_linked})
