// A library that a user may have preloaded, with a sin that would be noticed at once.
extern "C" double sin(double x);  // NOLINT

extern "C" double sin(double x) {
    return x;
}
