// SPDX-License-Identifier: MIT
// ETC1S under BasisLZ: streams written here by an encoder of the KTX 2.0 specification's bitstream that chooses among
// everything the format can say at random, against the texels that the ETC1 rules give for its indices.
#include "renderer/image/basis_lz.h"

#include <numeric>
#include <random>

#include "tests/support/ktx2_writer.h"

namespace candela {
namespace {

using test::append_number;
using test::Bytes;

class BitWriter {
  public:
    void put(uint32_t value, unsigned count) {
        for (unsigned i = 0; i < count; ++i, ++used_) {
            if (used_ % 8 == 0) bytes_.push_back(std::byte{0});
            bytes_.back() |= static_cast<std::byte>((value >> i & 1u) << used_ % 8);
        }
    }
    // A code, highest bit first.
    void put_code(uint32_t code, unsigned length) {
        while (length-- > 0)
            put(code >> length & 1u, 1);
    }
    void put_chunked(uint32_t value, unsigned digit_bits) {
        for (;; value >>= digit_bits) {
            const uint32_t digit = value & ((1u << digit_bits) - 1);
            const bool more = value >> digit_bits != 0;
            put(digit | (more ? 1u << digit_bits : 0u), digit_bits + 1);
            if (!more) return;
        }
    }
    const Bytes& bytes() const { return bytes_; }

  private:
    Bytes bytes_;
    unsigned used_ = 0;
};

// RFC 1951, 3.2.2.
struct Code {
    std::vector<uint8_t> lengths;
    std::vector<uint32_t> codes;
    explicit Code(std::vector<uint8_t> of) : lengths(std::move(of)), codes(lengths.size()) {
        uint32_t next = 0;
        for (unsigned length = 1; length <= 16; ++length, next <<= 1) {
            for (size_t i = 0; i < lengths.size(); ++i) {
                if (lengths[i] == length) codes[i] = next++;
            }
        }
    }
    void put(BitWriter& out, uint32_t symbol) const {
        ASSERT_LT(symbol, codes.size());
        out.put_code(codes[symbol], lengths[symbol]);
    }
};

// Codes for n symbols, as short as each other within a bit.
Code even_code(size_t n) {
    if (n == 1) return Code({1});
    unsigned bits = 0;
    while (size_t{2} << bits <= n)
        ++bits;
    std::vector<uint8_t> lengths(n, static_cast<uint8_t>(bits + 1));
    std::fill_n(lengths.begin(), (size_t{2} << bits) - n, static_cast<uint8_t>(bits));
    return Code(lengths);
}

// Codes of every length from 1 to 16 for 17 of n symbols, spread over them; none for the others.
Code skewed_code(size_t n) {
    std::vector<uint8_t> lengths(n, 0);
    for (size_t k = 0; k < 17; ++k)
        lengths[k * (n - 1) / 16] = static_cast<uint8_t>(std::min<size_t>(k + 1, 16));
    return Code(lengths);
}

void put_table(BitWriter& out, const Code& code) {
    // Lengths are sent by a code of 4 bits for the symbols 0 to 10 and 5 bits for the others.
    std::vector<uint8_t> length_lengths(21, 5);
    std::fill_n(length_lengths.begin(), 11, uint8_t{4});
    const Code length_code(length_lengths);
    out.put(static_cast<uint32_t>(code.lengths.size()), 14);
    out.put(21, 5);
    for (const int symbol : {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16})
        out.put(length_lengths[static_cast<size_t>(symbol)], 3);
    for (size_t i = 0; i < code.lengths.size();) {
        size_t run = 1;
        while (i + run < code.lengths.size() && code.lengths[i + run] == code.lengths[i])
            ++run;
        const bool zeros = code.lengths[i] == 0, repeat = !zeros && i > 0 && code.lengths[i - 1] == code.lengths[i];
        const size_t least = zeros ? 11 : 7, most = zeros ? 138 : 134;
        if ((zeros || repeat) && run >= 3) {
            run = std::min(run, most);
            const bool long_run = run >= least;
            if (!long_run) run = std::min<size_t>(run, zeros ? 10 : 6);
            length_code.put(out, zeros ? (long_run ? 18 : 17) : (long_run ? 20 : 19));
            out.put(static_cast<uint32_t>(run - (long_run ? least : 3)), long_run ? 7 : zeros ? 3 : 2);
            i += run;
        } else {
            length_code.put(out, code.lengths[i++]);
        }
    }
}

TEST(BasisLz, HuffmanTablesOfAllShapes) {
    std::mt19937 random(3);
    for (const Code& code : {even_code(1), even_code(2), even_code(21), even_code(1000), even_code(16383),
                             skewed_code(17), skewed_code(300), skewed_code(9000)}) {
        std::vector<uint32_t> symbols;
        for (uint32_t i = 0; i < code.lengths.size(); ++i) {
            if (code.lengths[i] != 0) symbols.push_back(i);
        }
        std::shuffle(symbols.begin(), symbols.end(), random);
        BitWriter out;
        put_table(out, code);
        for (const uint32_t symbol : symbols)
            code.put(out, symbol);
        BitReader in(out.bytes());
        const HuffmanTable table = read_huffman_table(in);
        for (const uint32_t symbol : symbols)
            ASSERT_EQ(table.decode(in), symbol) << code.lengths.size() << " symbols";
    }
}

TEST(BasisLz, HuffmanTablesThatCannotBe) {
    using Lengths = std::vector<uint8_t>;
    EXPECT_THROW(HuffmanTable(Lengths{1, 1, 1}), ImageError) << "more codes than room";
    EXPECT_THROW(HuffmanTable(Lengths{2, 2, 2}), ImageError) << "room without a code";
    EXPECT_THROW(HuffmanTable(Lengths{17}), ImageError);
    BitReader none({});
    EXPECT_THROW(HuffmanTable().decode(none), ImageError);
    const Bytes ones(4, std::byte{255});
    BitReader wrong(ones);
    EXPECT_THROW(HuffmanTable(Lengths{0, 1}).decode(wrong), ImageError) << "its only code is 0";
    BitReader short_of({ones.data(), 1});
    short_of.take(7);
    EXPECT_THROW(HuffmanTable(Lengths{2, 2, 2, 2}).decode(short_of), ImageError) << "one bit of two";
}

struct Endpoint {
    uint32_t color[3], intensity;
};
using Selector = std::array<uint8_t, 16>;  // 0..3 of each texel

struct Book {
    std::vector<Endpoint> endpoints;
    std::vector<Selector> selectors;
    size_t history = 0;
};

// KHR Data Format Specification, table of ETC1 intensity modifiers.
Rgba8 texel_of(const Endpoint& endpoint, unsigned selector) {
    static const int table[8][4] = {{-8, -2, 2, 8},     {-17, -5, 5, 17},   {-29, -9, 9, 29},     {-42, -13, 13, 42},
                                    {-60, -18, 18, 60}, {-80, -24, 24, 80}, {-106, -33, 33, 106}, {-183, -47, 47, 183}};
    Rgba8 out(0, 0, 0, 255);
    for (int c = 0; c < 3; ++c) {
        const auto base = static_cast<int>(endpoint.color[c] << 3 | endpoint.color[c] >> 2);
        out[c] = static_cast<uint8_t>(std::clamp(base + table[endpoint.intensity][selector], 0, 255));
    }
    return out;
}

Book random_book(size_t endpoints, size_t selectors, size_t history, bool grey, std::mt19937& random) {
    Book book;
    book.history = history;
    for (size_t i = 0; i < endpoints; ++i) {
        Endpoint e{{static_cast<uint32_t>(random() % 32), static_cast<uint32_t>(random() % 32),
                    static_cast<uint32_t>(random() % 32)},
                   static_cast<uint32_t>(random() % 8)};
        if (grey) e.color[1] = e.color[2] = e.color[0];
        book.endpoints.push_back(e);
    }
    for (size_t i = 0; i < selectors; ++i) {
        Selector s;
        for (uint8_t& value : s)
            value = static_cast<uint8_t>(random() % 4);
        book.selectors.push_back(s);
    }
    return book;
}

Bytes endpoint_section(const Book& book, bool grey) {
    BitWriter out;
    const Code delta = even_code(32), intensity = even_code(8);
    for (int i = 0; i < 3; ++i)
        put_table(out, delta);
    put_table(out, intensity);
    out.put(grey ? 1 : 0, 1);
    Endpoint last{{16, 16, 16}, 0};
    for (const Endpoint& e : book.endpoints) {
        intensity.put(out, (e.intensity - last.intensity) & 7u);
        for (int c = 0; c < (grey ? 1 : 3); ++c)
            delta.put(out, (e.color[c] - last.color[c]) & 31u);
        last = e;
    }
    return out.bytes();
}

Bytes selector_section(const Book& book, bool raw) {
    BitWriter out;
    out.put(0, 2);
    out.put(raw ? 1 : 0, 1);
    const Code delta = even_code(256);
    if (!raw) put_table(out, delta);
    uint32_t last[4] = {};
    for (size_t i = 0; i < book.selectors.size(); ++i) {
        for (size_t y = 0; y < 4; ++y) {
            uint32_t row = 0;
            for (size_t x = 0; x < 4; ++x)
                row |= uint32_t{book.selectors[i][4 * y + x]} << (2 * x);
            if (raw || i == 0) {
                out.put(row, 8);
            } else {
                delta.put(out, row ^ last[y]);
            }
            last[y] = row;
        }
    }
    return out.bytes();
}

struct Tables {
    Code prediction = even_code(257), delta, selector, run = even_code(64);
    explicit Tables(const Book& book)
        : delta(even_code(book.endpoints.size())), selector(even_code(book.selectors.size() + book.history + 1)) {}
    Bytes section(const Book& book) const {
        BitWriter out;
        for (const Code* code : {&prediction, &delta, &selector, &run})
            put_table(out, *code);
        out.put(static_cast<uint32_t>(book.history), 13);
        return out.bytes();
    }
};

// A slice of random indices, written with all the ways of predicting and repeating them.
struct Slice {
    Bytes bytes;
    std::vector<size_t> endpoint, selector;  // of each block
};

Slice random_slice(const Book& book, const Tables& tables, size_t columns, size_t rows, std::mt19937& random) {
    const auto chance = [&](int percent) { return static_cast<int>(random() % 100) < percent; };
    const size_t blocks = columns * rows;
    Slice slice;
    slice.endpoint.resize(blocks);
    slice.selector.resize(blocks);

    // Where each endpoint comes from: 0 left, 1 above, 2 above left, 3 a difference. Some stretches are all alike.
    std::vector<uint32_t> from(blocks);
    for (size_t y = 0; y < rows; ++y) {
        for (size_t x = 0; x < columns; ++x) {
            uint32_t choice = y / 2 % 3 == 1 ? 1 : static_cast<uint32_t>(random() % 4);
            if ((choice == 0 && x == 0) || (choice == 1 && y == 0) || (choice == 2 && (x == 0 || y == 0))) choice = 3;
            from[y * columns + x] = choice;
        }
    }
    const size_t groups_across = (columns + 1) / 2, groups_down = (rows + 1) / 2;
    std::vector<uint32_t> groups(groups_across * groups_down, 0);
    for (size_t y = 0; y < rows; ++y) {
        for (size_t x = 0; x < columns; ++x)
            groups[y / 2 * groups_across + x / 2] |= from[y * columns + x] << (2 * (x % 2) + 4 * (y % 2));
    }

    BitWriter out;
    size_t repeated_groups = 0;
    uint32_t last_group = 0;
    std::vector<size_t> history(book.history, 0);
    size_t rover = book.history / 2, repeated_selectors = 0;
    size_t previous = 0;
    for (size_t y = 0; y < rows; ++y) {
        for (size_t x = 0; x < columns; ++x) {
            const size_t at = y * columns + x;
            if (x % 2 == 0 && y % 2 == 0) {
                const size_t group = y / 2 * groups_across + x / 2;
                if (repeated_groups > 0) {
                    --repeated_groups;
                } else {
                    size_t run = 0;
                    while (group > 0 && group + run < groups.size() && groups[group + run] == last_group)
                        ++run;
                    if (run >= 3) {
                        tables.prediction.put(out, 256);
                        out.put_chunked(static_cast<uint32_t>(run - 3), 4);
                        repeated_groups = run - 1;
                    } else {
                        tables.prediction.put(out, last_group = groups[group]);
                    }
                }
            }
            const size_t count = book.endpoints.size();
            switch (from[at]) {
                case 0:
                    slice.endpoint[at] = slice.endpoint[at - 1];
                    break;
                case 1:
                    slice.endpoint[at] = slice.endpoint[at - columns];
                    break;
                case 2:
                    slice.endpoint[at] = slice.endpoint[at - columns - 1];
                    break;
                default:
                    slice.endpoint[at] = random() % count;
                    tables.delta.put(out, static_cast<uint32_t>((slice.endpoint[at] + count - previous) % count));
            }
            previous = slice.endpoint[at];

            // A selector is a run of the history's first, a place of the history, or new.
            const auto use = [&](size_t index) {
                slice.selector[at] = history[index];
                std::swap(history[index], history[index / 2]);
            };
            const auto selectors = static_cast<uint32_t>(book.selectors.size());
            const auto run_symbol = static_cast<uint32_t>(selectors + book.history);
            if (repeated_selectors > 0) {
                --repeated_selectors;
                use(0);
            } else if (book.history > 0 && chance(5)) {
                const size_t run = chance(50) ? 3 + random() % 63 : 66 + random() % 200;
                tables.selector.put(out, run_symbol);
                tables.run.put(out, static_cast<uint32_t>(std::min<size_t>(run - 3, 63)));
                if (run - 3 >= 63) out.put_chunked(static_cast<uint32_t>(run - 3), 7);
                repeated_selectors = run - 1;
                use(0);
            } else if (book.history > 0 && chance(50)) {
                const size_t index = random() % book.history;
                tables.selector.put(out, static_cast<uint32_t>(selectors + index));
                use(index);
            } else {
                slice.selector[at] = random() % selectors;
                tables.selector.put(out, static_cast<uint32_t>(slice.selector[at]));
                if (book.history > 0) {
                    history[rover++] = slice.selector[at];
                    if (rover == book.history) rover = book.history / 2;
                }
            }
        }
    }
    slice.bytes = out.bytes();
    return slice;
}

Bytes global_data(const Book& book, const Tables& tables, bool grey, bool raw,
                  const std::vector<std::array<uint32_t, 5>>& pictures) {
    const Bytes sections[] = {endpoint_section(book, grey), selector_section(book, raw), tables.section(book)};
    Bytes out;
    append_number(out, book.endpoints.size(), 2);
    append_number(out, book.selectors.size(), 2);
    for (const Bytes& section : sections)
        append_number(out, section.size(), 4);
    append_number(out, 0, 4);
    for (const auto& picture : pictures) {
        for (const uint32_t field : picture)
            append_number(out, field, 4);
    }
    for (const Bytes& section : sections)
        out.insert(out.end(), section.begin(), section.end());
    return out;
}

TEST(BasisLz, RandomSlicesGiveTheTexelsOfTheirIndices) {
    using Second = BasisLz::SecondSlice;
    std::mt19937 random(11);
    for (int trial = 0; trial < 60; ++trial) {
        const bool grey = trial % 4 == 0, raw = trial % 3 == 0;
        const size_t histories[] = {64, 8, 1, 0};
        const Book book = random_book(1 + random() % 300, 1 + random() % 500, histories[trial % 4], grey, random);
        const Tables tables(book);
        const int width = 1 + static_cast<int>(random() % 150), height = 1 + static_cast<int>(random() % 150);
        const auto columns = static_cast<size_t>((width + 3) / 4), rows = static_cast<size_t>((height + 3) / 4);
        const Second second = trial % 3 == 0 ? Second::none : trial % 3 == 1 ? Second::alpha : Second::green;
        const Slice first = random_slice(book, tables, columns, rows, random);
        const Slice other = random_slice(book, tables, columns, rows, random);

        // The picture asked for is the second of the file, and its slices lie in the other order.
        Bytes level = other.bytes;
        level.insert(level.end(), first.bytes.begin(), first.bytes.end());
        std::array<uint32_t, 5> slices = {0, static_cast<uint32_t>(other.bytes.size()),
                                          static_cast<uint32_t>(first.bytes.size()), 0, 0};
        if (second != Second::none) slices[4] = static_cast<uint32_t>(other.bytes.size());
        const Bytes data = global_data(book, tables, grey, raw, {{0, 0, 1, 0, 0}, slices});
        const ImageRgba8 image = BasisLz(data, 2).decode(1, level, width, height, second);

        ASSERT_EQ(image.width(), width);
        ASSERT_EQ(image.height(), height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const size_t block = static_cast<size_t>(y / 4) * columns + static_cast<size_t>(x / 4);
                const auto in_block = static_cast<size_t>(y % 4 * 4 + x % 4);
                const auto texel = [&](const Slice& slice) {
                    return texel_of(book.endpoints[slice.endpoint[block]],
                                    book.selectors[slice.selector[block]][in_block]);
                };
                Rgba8 expected = texel(first);
                if (second == Second::alpha) expected.a = texel(other).g;
                if (second == Second::green) expected.g = texel(other).g;
                ASSERT_EQ(image(x, y), expected) << "trial " << trial << " at " << x << ", " << y;
            }
        }
    }
}

TEST(BasisLz, WhatPointsOutsideIsRefused) {
    using Second = BasisLz::SecondSlice;
    std::mt19937 random(5);
    const Book book = random_book(20, 30, 8, false, random);
    const Tables tables(book);
    const Slice slice = random_slice(book, tables, 8, 8, random);
    const auto size = static_cast<uint32_t>(slice.bytes.size());
    const auto failure = [&](const std::array<uint32_t, 5>& picture, const Bytes& level, Second second) {
        try {
            BasisLz(global_data(book, tables, false, false, {picture}), 1).decode(0, level, 32, 32, second);
        } catch (const ImageError& error) {
            return std::string(error.what());
        }
        return std::string("decoded");
    };
    EXPECT_EQ(failure({0, 0, size, 0, 0}, slice.bytes, Second::none), "decoded");
    EXPECT_NE(failure({0, 1, size, 0, 0}, slice.bytes, Second::none).find("a slice lies outside"), std::string::npos);
    EXPECT_NE(failure({0, 0xffffffff, size, 0, 0}, slice.bytes, Second::none).find("outside"), std::string::npos);
    EXPECT_NE(failure({0, 0, size - 3, 0, 0}, slice.bytes, Second::none).find("ends too early"), std::string::npos);
    EXPECT_NE(failure({0, 0, size, 2, size}, slice.bytes, Second::alpha).find("green slice lies outside"),
              std::string::npos);
    EXPECT_NE(failure({2, 0, size, 0, 0}, slice.bytes, Second::none).find("animation"), std::string::npos);
    EXPECT_NE(failure({0, 0, size, 0, 0}, slice.bytes, Second::alpha).find("number of slices"), std::string::npos);
    EXPECT_NE(failure({0, 0, size, 0, size}, slice.bytes, Second::none).find("number of slices"), std::string::npos);

    // The first block has no neighbours; a history of 8 has no ninth place; the codebooks end.
    const auto first_block = [&](uint32_t prediction, uint32_t delta, uint32_t selector) {
        BitWriter out;
        tables.prediction.put(out, prediction);
        if (prediction == 3) tables.delta.put(out, delta);
        tables.selector.put(out, selector);
        const auto bytes = static_cast<uint32_t>(out.bytes().size());
        return failure({0, 0, bytes, 0, 0}, out.bytes(), Second::none);
    };
    for (const uint32_t prediction : {0u, 1u, 2u}) {
        EXPECT_NE(first_block(prediction, 0, 0).find("predicted from outside"), std::string::npos) << prediction;
    }
    EXPECT_NE(first_block(3, 0, 0).find("ends too early"), std::string::npos);
}

TEST(BasisLz, IndicesBeyondTheCodebooksAreRefused) {
    std::mt19937 random(6);
    const auto failure = [](const Book& book, const Tables& tables, uint32_t delta, uint32_t selector) {
        BitWriter out;
        tables.prediction.put(out, 3);
        tables.delta.put(out, delta);
        tables.selector.put(out, selector);
        const Bytes data = global_data(book, tables, false, false, {{0, 0, 100, 0, 0}});
        Bytes level = out.bytes();
        level.resize(100);
        try {
            BasisLz(data, 1).decode(0, level, 4, 4, BasisLz::SecondSlice::none);
        } catch (const ImageError& error) {
            return std::string(error.what());
        }
        return std::string("decoded");
    };
    const Book book = random_book(20, 30, 8, false, random);
    Tables tables(book);
    tables.delta = even_code(100);
    EXPECT_EQ(failure(book, tables, 39, 0), "decoded") << "wrapped around once";
    EXPECT_NE(failure(book, tables, 40, 0).find("endpoint index is out of range"), std::string::npos);
    EXPECT_NE(failure(book, tables, 99, 0).find("endpoint index is out of range"), std::string::npos);
    EXPECT_EQ(failure(book, tables, 0, 37), "decoded") << "the last place of the history";

    // A codebook without selectors leaves the history full of the first.
    const Book none = random_book(20, 0, 8, false, random);
    EXPECT_NE(failure(none, Tables(none), 0, 0).find("selector index is out of range"), std::string::npos);
    Book forgetful = book;
    forgetful.history = 0;
    EXPECT_NE(failure(forgetful, tables, 0, 35).find("beyond the history"), std::string::npos);
}

}  // namespace
}  // namespace candela
