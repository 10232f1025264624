// What it must do: zlib's own bytes, so that no file changes; also where zlib's version differs.
// What it assumes: nothing is ever worth a string; zlib's blocks end after 16383 literals.
// How it goes: block by block the frequencies, code lengths by Huffman's algorithm over a heap
// whose
//   ties are zlib's (less frequent first, then less deep), then the shortest of a stored block, one
//   with the fixed codes, and one with its own, whose lengths are sent as RFC 1951, 3.2.7 says.
// What it keeps: nothing.
#include "render/codecs/literal_deflate.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <zlib.h>

namespace reprise::render {

namespace {

constexpr std::size_t block_literals = 16383;
constexpr int end_of_block = 256;

/// A symbol's code, first bit lowest.
struct Code {
    std::uint32_t bits = 0;
    int length = 0;
};

/// Bits from the lowest on.
class BitWriter {
  public:
    explicit BitWriter(std::size_t most) : bytes_(most + 8) {}

    /// Up to 57 bits at once.
    void put(std::uint64_t bits, int count) {
        waiting_ |= bits << count_;
        count_ += count;
        std::memcpy(bytes_.data() + size_, &waiting_, sizeof(waiting_));
        const int whole = count_ / 8;
        size_ += static_cast<std::size_t>(whole);
        waiting_ = whole == 8 ? 0 : waiting_ >> (8 * whole);
        count_ -= 8 * whole;
    }

    /// Codes of bytes. What is kept from one to the next is in no memory that bytes are written to.
    void put_coded(std::span<const std::uint8_t> bytes, const Code* codes) {
        std::uint8_t* to = bytes_.data() + size_;
        std::uint64_t waiting = waiting_;
        int count = count_;
        const auto add = [&](std::uint8_t byte) {
            waiting |= std::uint64_t{codes[byte].bits} << count;
            count += codes[byte].length;
        };
        const auto flush = [&] {
            std::memcpy(to, &waiting, sizeof(waiting));
            to += count / 8;
            waiting >>= count & ~7;  // 56 bits at most
            count &= 7;
        };
        std::size_t i = 0;
        for (; i + 3 <= bytes.size(); i += 3) {  // 7 + 45 bits at most
            add(bytes[i]);
            add(bytes[i + 1]);
            add(bytes[i + 2]);
            flush();
        }
        for (; i < bytes.size(); ++i) {
            add(bytes[i]);
            flush();
        }
        size_ = static_cast<std::size_t>(to - bytes_.data());
        waiting_ = waiting;
        count_ = count;
    }

    void fill_byte() {
        if (count_ > 0)
            put(0, 8 - count_);
    }

    void put_bytes(std::span<const std::uint8_t> bytes) {
        std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
        size_ += bytes.size();
    }

    std::vector<std::uint8_t> take() {
        bytes_.resize(size_);
        return std::move(bytes_);
    }

  private:
    std::vector<std::uint8_t> bytes_;
    std::size_t size_ = 0;
    std::uint64_t waiting_ = 0;
    int count_ = 0;
};

/// Huffman's code of up to 286 symbols, no longer than so many bits.
class Codes {
  public:
    Codes(std::span<const std::uint32_t> frequencies, int longest) : codes_(frequencies.size()) {
        find_lengths(frequencies, longest);
        number(longest);
    }

    const Code& operator[](std::size_t symbol) const { return codes_[symbol]; }

    const Code* data() const { return codes_.data(); }

    /// Behind the last symbol that has a code.
    std::size_t end() const {
        std::size_t end = codes_.size();
        while (end > 0 && codes_[end - 1].length == 0)
            --end;
        return end;
    }

    std::uint64_t bits_of(std::span<const std::uint32_t> frequencies) const {
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < codes_.size(); ++i)
            bits += std::uint64_t{frequencies[i]} * static_cast<std::uint64_t>(codes_[i].length);
        return bits;
    }

  private:
    struct Node {
        std::uint32_t frequency = 0;
        int depth = 0;
        int parent = -1;
        int length = 0;
    };

    void find_lengths(std::span<const std::uint32_t> frequencies, int longest);
    void number(int longest);

    std::vector<Code> codes_;
};

/// Of the numbers of nodes: the least frequent on top.
template <typename Node>
class Heap {
  public:
    explicit Heap(const std::vector<Node>& nodes) : nodes_(nodes) {}

    void add(int node) { heap_.push_back(node); }

    void order() {
        for (std::size_t place = heap_.size() / 2; place > 0; --place)
            sink(place - 1);
    }

    std::size_t size() const { return heap_.size(); }

    int top() const { return heap_.front(); }

    /// The last one takes the top's place.
    int take_top() {
        const int top = heap_.front();
        heap_.front() = heap_.back();
        heap_.pop_back();
        if (!heap_.empty())
            sink(0);
        return top;
    }

    void replace_top(int node) {
        heap_.front() = node;
        sink(0);
    }

  private:
    bool is_smaller(int one, int other) const {
        const Node& a = nodes_[static_cast<std::size_t>(one)];
        const Node& b = nodes_[static_cast<std::size_t>(other)];
        return a.frequency < b.frequency || (a.frequency == b.frequency && a.depth <= b.depth);
    }

    void sink(std::size_t place) {
        const int moved = heap_[place];
        for (std::size_t child = 2 * place + 1; child < heap_.size(); child = 2 * place + 1) {
            if (child + 1 < heap_.size() && is_smaller(heap_[child + 1], heap_[child]))
                ++child;
            if (is_smaller(moved, heap_[child]))
                break;
            heap_[place] = heap_[child];
            place = child;
        }
        heap_[place] = moved;
    }

    const std::vector<Node>& nodes_;
    std::vector<int> heap_;
};

void Codes::find_lengths(std::span<const std::uint32_t> frequencies, int longest) {
    std::vector<Node> nodes(frequencies.size());
    nodes.reserve(2 * frequencies.size());
    Heap<Node> heap(nodes);
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        nodes[i].frequency = frequencies[i];
        if (frequencies[i] > 0)
            heap.add(static_cast<int>(i));
    }
    // Two codes there must be; those that nobody uses are the first ones.
    for (std::size_t i = 0; heap.size() < 2; ++i)
        if (nodes[i].frequency == 0) {
            nodes[i].frequency = 1;
            heap.add(static_cast<int>(i));
        }
    heap.order();
    std::vector<int> taken;  // from the least frequent on
    while (heap.size() > 1) {
        const int one = heap.take_top();
        const int other = heap.top();
        taken.insert(taken.end(), {one, other});
        Node& a = nodes[static_cast<std::size_t>(one)];
        Node& b = nodes[static_cast<std::size_t>(other)];
        const auto both = static_cast<int>(nodes.size());
        a.parent = b.parent = both;
        nodes.push_back({a.frequency + b.frequency, std::max(a.depth, b.depth) + 1, -1, 0});
        heap.replace_top(both);
    }
    // From the root down; what would be too long is cut, and others grow for it.
    std::vector<int> count(static_cast<std::size_t>(longest) + 1, 0);
    int cut = 0;
    for (auto node = taken.rbegin(); node != taken.rend(); ++node) {
        Node& own = nodes[static_cast<std::size_t>(*node)];
        own.length = nodes[static_cast<std::size_t>(own.parent)].length + 1;
        if (own.length > longest) {
            own.length = longest;
            ++cut;
        }
        if (static_cast<std::size_t>(*node) < frequencies.size())
            ++count[static_cast<std::size_t>(own.length)];
    }
    const bool fits = cut == 0;
    for (; cut > 0; cut -= 2) {
        auto length = static_cast<std::size_t>(longest) - 1;
        while (count[length] == 0)
            --length;
        --count[length];
        count[length + 1] += 2;
        --count[static_cast<std::size_t>(longest)];
    }
    for (std::size_t i = 0; i < codes_.size(); ++i)
        codes_[i].length = nodes[i].length;
    if (fits)
        return;
    auto leaf = taken.begin();
    for (int length = longest; length > 0; --length)
        for (int left = count[static_cast<std::size_t>(length)]; left > 0; ++leaf)
            if (static_cast<std::size_t>(*leaf) < frequencies.size()) {
                codes_[static_cast<std::size_t>(*leaf)].length = length;
                --left;
            }
}

/// RFC 1951, 3.2.2: shorter ones first, then by symbol.
void Codes::number(int longest) {
    std::uint32_t next = 0;
    for (int length = 1; length <= longest; ++length) {
        for (Code& code : codes_) {
            if (code.length != length)
                continue;
            std::uint32_t turned = 0;
            for (int bit = 0; bit < length; ++bit)
                turned |= (next >> bit & 1U) << (length - 1 - bit);
            code.bits = turned;
            ++next;
        }
        next <<= 1;
    }
}

/// How long codes are, in a row, as 0 to 15 and three kinds of repetition with their extra bits.
struct LengthWord {
    std::size_t word;
    std::uint32_t extra;
};

constexpr std::array<int, 19> extra_bits{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 3, 7};
constexpr std::array<std::size_t, 19> order_of_words{
    16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

/// Of one code: runs never go on in the next one.
void add_lengths(const Codes& codes, std::vector<LengthWord>& words) {
    int last = -1;
    for (std::size_t i = 0; i < codes.end();) {
        const int length = codes[i].length;
        const std::size_t most = length == 0 ? 138 : length == last ? 6 : 7;
        std::size_t run = 1;
        while (i + run < codes.end() && run < most && codes[i + run].length == length)
            ++run;
        i += run;
        const auto said = static_cast<std::uint32_t>(run);
        if (length == 0) {
            if (run < 3)
                words.insert(words.end(), run, {0, 0});
            else if (run <= 10)
                words.push_back({17, said - 3});
            else
                words.push_back({18, said - 11});
        } else {
            const std::size_t own = length == last ? 0 : 1;
            if (run - own < 3) {
                words.insert(words.end(), run, {static_cast<std::size_t>(length), 0});
            } else {
                words.insert(words.end(), own, {static_cast<std::size_t>(length), 0});
                words.push_back({16, static_cast<std::uint32_t>(run - own) - 3});
            }
        }
        last = length;
    }
}

const Codes& fixed_codes() {
    // RFC 1951, 3.2.6: of frequencies whose Huffman codes have these lengths.
    static const Codes codes = [] {
        std::array<std::uint32_t, 288> frequencies{};
        for (std::size_t i = 0; i < frequencies.size(); ++i)
            frequencies[i] = i < 144 ? 2 : i < 256 ? 1 : i < 280 ? 4 : 2;
        return Codes(frequencies, 15);
    }();
    return codes;
}

using Frequencies = std::array<std::uint32_t, 286>;

Frequencies count(std::span<const std::uint8_t> literals) {
    // In four tables: who counts the same byte again waits for the first to arrive.
    std::array<std::array<std::uint32_t, 256>, 4> tables{};
    for (std::size_t i = 0; i < literals.size(); ++i)
        ++tables[i % 4][literals[i]];
    Frequencies all{};
    for (std::size_t i = 0; i < 256; ++i)
        all[i] = tables[0][i] + tables[1][i] + tables[2][i] + tables[3][i];
    all[end_of_block] = 1;
    return all;
}

void put_literals(BitWriter& to, std::span<const std::uint8_t> literals, const Codes& codes) {
    to.put_coded(literals, codes.data());
    to.put(codes[end_of_block].bits, codes[end_of_block].length);
}

void put_block(BitWriter& to, std::span<const std::uint8_t> literals, bool last) {
    const Frequencies frequencies = count(literals);
    const Codes codes(frequencies, 15);
    const Codes distances(std::array<std::uint32_t, 30>{}, 15);
    std::vector<LengthWord> words;
    add_lengths(codes, words);
    add_lengths(distances, words);
    std::array<std::uint32_t, 19> word_frequencies{};
    for (const LengthWord& one : words)
        ++word_frequencies[one.word];
    const Codes word_codes(word_frequencies, 7);
    std::size_t sent = order_of_words.size();
    while (sent > 4 && word_codes[order_of_words[sent - 1]].length == 0)
        --sent;
    std::uint64_t own_bits =
        codes.bits_of(frequencies) + word_codes.bits_of(word_frequencies) + 5 + 5 + 4 + 3 * sent;
    for (const LengthWord& one : words)
        own_bits += static_cast<std::uint64_t>(extra_bits[one.word]);
    std::uint64_t fixed_bits = 0;
    for (std::size_t i = 0; i < frequencies.size(); ++i)
        fixed_bits += frequencies[i] * static_cast<std::uint64_t>(fixed_codes()[i].length);
    const std::uint64_t own_bytes = (own_bits + 3 + 7) / 8;
    const std::uint64_t fixed_bytes = (fixed_bits + 3 + 7) / 8;

    enum Kind : std::uint64_t { stored = 0, fixed = 2, own = 4 };

    const std::uint64_t final = last ? 1 : 0;
    if (literals.size() + 4 <= std::min(own_bytes, fixed_bytes)) {
        to.put(stored | final, 3);
        to.fill_byte();
        to.put(literals.size(), 16);
        to.put(~literals.size() & 0xffffU, 16);
        to.put_bytes(literals);
    } else if (fixed_bytes <= own_bytes) {
        to.put(fixed | final, 3);
        put_literals(to, literals, fixed_codes());
    } else {
        to.put(own | final, 3);
        to.put(codes.end() - 257, 5);
        to.put(distances.end() - 1, 5);
        to.put(sent - 4, 4);
        for (std::size_t i = 0; i < sent; ++i)
            to.put(static_cast<std::uint64_t>(word_codes[order_of_words[i]].length), 3);
        for (const LengthWord& one : words) {
            to.put(word_codes[one.word].bits, word_codes[one.word].length);
            to.put(one.extra, extra_bits[one.word]);
        }
        put_literals(to, literals, codes);
    }
}

}  // namespace

std::vector<std::uint8_t> deflate_literals(std::span<const std::uint8_t> bytes) {
    const std::size_t blocks = bytes.size() / block_literals + 1;
    BitWriter to(bytes.size() + 16 * blocks + 1024);
    to.put(0x0178, 16);  // a window of 32 kB, the lowest level
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t first = i * block_literals;
        put_block(to,
                  bytes.subspan(first, std::min(block_literals, bytes.size() - first)),
                  i + 1 == blocks);
    }
    to.fill_byte();
    const auto sum =
        static_cast<std::uint32_t>(adler32(1, bytes.data(), static_cast<uInt>(bytes.size())));
    for (int shift = 24; shift >= 0; shift -= 8)
        to.put(sum >> shift & 0xffU, 8);
    return to.take();
}

}  // namespace reprise::render
