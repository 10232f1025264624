#include "world/digest.h"

#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace reprise {

using world::Digest128;
using world::Hasher;

namespace {

template <typename T>
Digest128 digest_of(const T& value) {
    Hasher hasher;
    hasher.add(value);
    return hasher.digest128();
}

}  // namespace

/// From xxHash's own test vectors (XXH3 with seed 0 of no bytes).
TEST(Digest, IsXxh3) {
    EXPECT_EQ(world::to_hex(world::digest128("")), "99aa06d3014798d86001c324468d497f");
}

TEST(Digest, DoesNotDependOnHowTheBytesArrive) {
    std::string bytes;
    for (int i = 0; i < 1000; ++i)
        bytes.push_back(static_cast<char>(i * 7));
    for (const std::size_t step : {1u, 3u, 64u, 240u, 999u, 1000u}) {
        Hasher hasher;
        for (std::size_t from = 0; from < bytes.size(); from += step)
            hasher.add_bytes(bytes.data() + from, std::min(step, bytes.size() - from));
        EXPECT_EQ(hasher.digest128(), world::digest128(bytes)) << step;
        EXPECT_EQ(hasher.digest64(), world::digest128(bytes).low()) << step;
    }
}

TEST(Digest, TellsWhereOneTextEndsAndTheNextBegins) {
    Hasher one;
    one.add_text("ab");
    one.add_text("c");
    Hasher other;
    other.add_text("a");
    other.add_text("bc");
    EXPECT_NE(one.digest128(), other.digest128());
}

TEST(Digest, TellsAnEmptyListFromNone) {
    Hasher empty;
    empty.add(std::span<const double>());
    EXPECT_NE(empty.digest128(), Hasher().digest128());
}

TEST(Digest, SeesTheSignOfZero) {
    EXPECT_NE(digest_of(0.0), digest_of(-0.0));
}

TEST(Digest, SeesTheLastBit) {
    const double one = 1.0;
    EXPECT_NE(digest_of(one), digest_of(one + std::numeric_limits<double>::epsilon()));
}

TEST(Digest, CanBeReadWhileGathering) {
    Hasher hasher;
    hasher.add(1);
    const Digest128 early = hasher.digest128();
    EXPECT_EQ(hasher.digest128(), early);
    hasher.add(2);
    EXPECT_NE(hasher.digest128(), early);
}

TEST(Digest, PrintsTheHighHalfFirst) {
    EXPECT_EQ(world::to_hex(Digest128(0x1u, 0xabcdef0123456789u)),
              "abcdef01234567890000000000000001");
}

TEST(Chain, DependsOnAllThatWentBefore) {
    const Digest128 start;
    const Digest128 good = digest_of(1);
    const Digest128 bad = digest_of(2);
    const auto history = [&](const std::vector<Digest128>& states) {
        Digest128 last = start;
        for (const Digest128& state : states)
            last = world::chain(last, state);
        return last;
    };
    EXPECT_EQ(history({good, good, bad}), history({good, good, bad}));
    EXPECT_NE(history({good, bad, good}), history({good, good, good}));
    EXPECT_NE(history({good, bad}), history({bad, good}));
    EXPECT_NE(history({good}), history({good, good}));
    EXPECT_NE(history({good}), good);
}

}  // namespace reprise
