# glibc chooses its sin, exp and kin by the CPU it finds; they differ in the last bit, and traffic is
# chaotic. So programs that simulate carry musl's, as one object in the executable: the dynamic
# linker then binds Bullet, SUMO and Lua to it as well. docs/determinism.md says more. Not fmod: it
# is exact, so equal everywhere, and scripting/lua/charged.cpp has one that scripts pay for.
find_file(MUSL_LIBC libc.a PATHS /usr/lib/x86_64-linux-musl NO_DEFAULT_PATH REQUIRED)
set(portable_functions
    sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2
    log10 log1p pow sincos cbrt hypot erf erfc tgamma lgamma remainder
    sinf cosf tanf asinf acosf atanf atan2f sinhf coshf tanhf asinhf acoshf atanhf expf exp2f exp10f
    expm1f logf log2f log10f log1pf powf sincosf cbrtf hypotf erff erfcf tgammaf lgammaf fmodf
    remainderf)
list(TRANSFORM portable_functions PREPEND "--undefined=" OUTPUT_VARIABLE wanted)
list(TRANSFORM portable_functions PREPEND "--keep-global-symbol=" OUTPUT_VARIABLE kept)

set(portable_math_object ${PROJECT_BINARY_DIR}/generated/portable_math.o)
add_custom_command(
  OUTPUT ${portable_math_object}
  COMMAND ${CMAKE_LINKER} -r -o ${portable_math_object}.all ${wanted} ${MUSL_LIBC}
  COMMAND ${CMAKE_OBJCOPY} ${kept} ${portable_math_object}.all ${portable_math_object}
  DEPENDS ${MUSL_LIBC} VERBATIM)
add_custom_target(portable_math_object DEPENDS ${portable_math_object})
add_library(portable_math OBJECT IMPORTED GLOBAL)
set_target_properties(portable_math PROPERTIES IMPORTED_OBJECTS ${portable_math_object})

# Links a program with it, every function visible to the libraries that the program loads.
function(reprise_portable_math program)
  target_link_libraries(${program} PRIVATE portable_math)
  add_dependencies(${program} portable_math_object)
  list(TRANSFORM portable_functions PREPEND "LINKER:--export-dynamic-symbol=" OUTPUT_VARIABLE exported)
  target_link_options(${program} PRIVATE ${exported})
  string(JOIN " " names ${portable_functions})
  target_compile_definitions(${program} PRIVATE REPRISE_PORTABLE_FUNCTIONS="${names}")
endfunction()
