# What a program that simulates takes from portable_math.o, and how it is linked with it (PortableMath.cmake).
set(portable_functions
    sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2
    log10 log1p pow sincos cbrt hypot erf erfc tgamma lgamma remainder
    sinf cosf tanf asinf acosf atanf atan2f sinhf coshf tanhf asinhf acoshf atanhf expf exp2f exp10f
    expm1f logf log2f log10f log1pf powf sincosf cbrtf hypotf erff erfcf tgammaf lgammaf fmodf
    remainderf)

# Links a program with it, every function visible to the libraries that the program loads.
function(reprise_portable_math program)
  target_link_libraries(${program} PRIVATE portable_math)
  if(TARGET portable_math_object)  # not where it came with the package
    add_dependencies(${program} portable_math_object)
  endif()
  list(TRANSFORM portable_functions PREPEND "LINKER:--export-dynamic-symbol=" OUTPUT_VARIABLE exported)
  target_link_options(${program} PRIVATE ${exported})
  string(JOIN " " names ${portable_functions})
  target_compile_definitions(${program} PRIVATE REPRISE_PORTABLE_FUNCTIONS="${names}")
endfunction()
