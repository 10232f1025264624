#pragma once

namespace reprise::cli {

/// For glibc's malloc in reprise-render, which reads it from GLIBC_TUNABLES before main: a town is
/// 100 MB of shapes that rays meet in no order, and a picture 25 MB of pixels. In pages of 2 MB,
/// and not given back between two pictures, both take a twelfth less time, for 4 % more memory. Who
/// starts reprise-render says so, unless the user has said something. Read by
/// tests/bench/picture_memory.py, too.
inline constexpr const char* picture_memory =
    "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=1073741824:"
    "glibc.malloc.trim_threshold=1073741824:glibc.malloc.top_pad=67108864";

}  // namespace reprise::cli
