#include "traffic/memory/small_blocks.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "process/copy.h"

namespace reprise::traffic {
namespace {

/// Sanitizers keep their own operators.
bool has_small_blocks() {
    return is_small_block(std::make_unique<int>().get());
}

TEST(SmallBlocks, AreApartFromEachOtherWhateverIsGivenBackBetween) {
    struct Held {
        unsigned char* bytes;
        std::size_t size;
        unsigned char mark;
    };

    const auto is_whole = [](const Held& held) {
        return std::all_of(held.bytes, held.bytes + held.size, [&](unsigned char byte) {
            return byte == held.mark;
        });
    };
    std::vector<Held> all;
    for (std::size_t i = 0; i < 20'000; ++i) {
        const std::size_t size = i * 7 % 1500;  // small and large ones, and none
        const Held held{
            static_cast<unsigned char*>(operator new(size)), size, static_cast<unsigned char>(i)};
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(held.bytes) % alignof(std::max_align_t), 0U);
        std::memset(held.bytes, held.mark, size);
        all.push_back(held);
        if (i % 3 != 0)
            continue;
        const std::size_t given_back = i * 31 % all.size();
        ASSERT_TRUE(is_whole(all[given_back])) << given_back;
        operator delete(all[given_back].bytes);
        all[given_back] = all.back();
        all.pop_back();
    }
    for (const Held& held : all) {
        EXPECT_TRUE(is_whole(held)) << held.size;
        operator delete(held.bytes, held.size);
    }
}

TEST(SmallBlocks, AreThoseOfTheFirstThreadAlone) {
    if (!has_small_blocks())
        GTEST_SKIP() << "a sanitizer's operators";
    EXPECT_TRUE(is_small_block(std::make_unique<std::string>().get()));
    EXPECT_FALSE(is_small_block(std::make_unique<char[]>(100'000).get()));
    bool of_another = true;
    std::thread([&] { of_another = is_small_block(std::make_unique<std::string>().get()); }).join();
    EXPECT_FALSE(of_another);
}

TEST(SmallBlocks, ThatAnotherThreadGivesBackAreGivenOutAgain) {
    if (!has_small_blocks())
        GTEST_SKIP() << "a sanitizer's operators";
    constexpr std::size_t size = 1008;  // of which nobody holds many
    constexpr int turns = 300'000;      // 300 MB, more than there is
    std::vector<void*> blocks(1000);
    for (int turn = 0; turn < turns; turn += static_cast<int>(blocks.size())) {
        for (void*& block : blocks) {
            block = operator new(size);
            ASSERT_TRUE(is_small_block(block)) << turn;
        }
        std::thread([&] {
            for (void* block : blocks)
                operator delete(block);
        }).join();
    }
}

TEST(SmallBlocks, GoOnInACopyOfTheProcess) {
    const auto ours = std::make_unique<std::string>(100, 'a');
    const std::string told = process::run_copy({"a copy", [&] {
                                                    std::vector<std::string> all(1000, *ours);
                                                    all.resize(1);
                                                    all.resize(3, std::string(50, 'b'));
                                                    return all.front() + all.back();
                                                }});
    EXPECT_EQ(told, std::string(100, 'a') + std::string(50, 'b'));
    EXPECT_EQ(*ours, std::string(100, 'a'));
}

}  // namespace
}  // namespace reprise::traffic
