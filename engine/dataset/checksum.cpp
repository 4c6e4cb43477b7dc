// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "base/ensure.h"
#include "base/input_file.h"
#include "base/threads.h"
#include "dataset/entry.h"

#ifdef __x86_64__
#include <cpuid.h>
#include <immintrin.h>
#endif

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr int kBits = 256;
constexpr std::size_t kBlock_bytes = 64;
constexpr std::size_t kPieceBytes = 1 << 20;

using State = std::array<std::uint32_t, 8>;

#ifdef __x86_64__

bool has_instructions() {
  unsigned a = 0;
  unsigned b = 0;
  unsigned c = 0;
  unsigned d = 0;
  return __builtin_cpu_supports("sse4.1") != 0 && __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & bit_SHA) != 0;
}

// FIPS 180-4, 4.2.2
alignas(16) constexpr std::array<std::uint32_t, 64> kConstants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

// Blocks of the message (FIPS 180-4, 6.2.2) by the processor's own instructions, four rounds at a time. The two
// registers hold the working variables as those want them: a, b, e, f and c, d, g, h.
[[gnu::target("sha,sse4.1")]] void add_blocks(State& state, const char* bytes, std::size_t blocks) {
  const auto at = [](const void* place) { return static_cast<const __m128i*>(place); };
  const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
  const __m128i abcd = _mm_shuffle_epi32(_mm_loadu_si128(at(state.data())), 0xb1);
  const __m128i efgh = _mm_shuffle_epi32(_mm_loadu_si128(at(state.data() + 4)), 0x1b);
  __m128i abef = _mm_alignr_epi8(abcd, efgh, 8);
  __m128i cdgh = _mm_blend_epi16(efgh, abcd, 0xf0);
  for (; blocks > 0; --blocks, bytes += kBlock_bytes) {
    const __m128i abef_before = abef;
    const __m128i cdgh_before = cdgh;
    __m128i words[4];  // of the message schedule, the last 16
    for (std::size_t i = 0; i < 4; ++i) words[i] = _mm_shuffle_epi8(_mm_loadu_si128(at(bytes + 16 * i)), big_endian);
    for (int i = 0; i < 16; ++i) {
      const __m128i sum = _mm_add_epi32(words[i % 4], _mm_load_si128(at(&kConstants[4 * i])));
      cdgh = _mm_sha256rnds2_epu32(cdgh, abef, sum);
      abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(sum, 0x0e));
      if (i >= 12) continue;
      const __m128i last = words[(i + 3) % 4];
      const __m128i early = _mm_sha256msg1_epu32(words[i % 4], words[(i + 1) % 4]);
      words[i % 4] = _mm_sha256msg2_epu32(_mm_add_epi32(early, _mm_alignr_epi8(last, words[(i + 2) % 4], 4)), last);
    }
    abef = _mm_add_epi32(abef, abef_before);
    cdgh = _mm_add_epi32(cdgh, cdgh_before);
  }
  const __m128i feba = _mm_shuffle_epi32(abef, 0x1b);
  const __m128i dchg = _mm_shuffle_epi32(cdgh, 0xb1);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data()), _mm_blend_epi16(feba, dchg, 0xf0));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data() + 4), _mm_alignr_epi8(dchg, feba, 8));
}

#else

bool has_instructions() {
  return false;
}

void add_blocks(State&, const char*, std::size_t) {}

#endif

// SHA-256 of all bytes that were added: by the processor's instructions in about a fifth of the time, else by FFmpeg.
class Checksum {
 public:
  Checksum() : sha_(av_sha_alloc()) {
    ENSURE(sha_ != nullptr);
    av_sha_init(sha_, kBits);
  }
  ~Checksum() { av_free(sha_); }
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(std::string_view bytes) {
    if (!has_instructions_) {
      av_sha_update(sha_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      return;
    }
    bytes_ += bytes.size();
    if (!rest_.empty()) {
      const std::size_t missing = std::min(kBlock_bytes - rest_.size(), bytes.size());
      rest_ += bytes.substr(0, missing);
      bytes.remove_prefix(missing);
      if (rest_.size() < kBlock_bytes) return;
      add_blocks(state_, rest_.data(), 1);
    }
    add_blocks(state_, bytes.data(), bytes.size() / kBlock_bytes);
    rest_ = bytes.substr(bytes.size() / kBlock_bytes * kBlock_bytes);
  }

  // To be called once; nothing may be added after it.
  [[nodiscard]] std::string text() {
    if (has_instructions_) return text_of_state();
    std::array<std::uint8_t, kBits / 8> digest{};
    av_sha_final(sha_, digest.data());
    std::string text;
    for (const std::uint8_t byte : digest) text += fmt::format("{:02x}", byte);
    return text;
  }

 private:
  // After the message a bit, zeros up to the end of a block, and the message's length in bits (FIPS 180-4, 5.1.1).
  [[nodiscard]] std::string text_of_state() {
    const std::uint64_t bits = bytes_ * 8;
    rest_ += '\x80';
    while (rest_.size() % kBlock_bytes != kBlock_bytes - 8) rest_ += '\0';
    for (int shift = 56; shift >= 0; shift -= 8) rest_ += static_cast<char>(bits >> shift);
    add_blocks(state_, rest_.data(), rest_.size() / kBlock_bytes);
    std::string text;
    for (const std::uint32_t word : state_) text += fmt::format("{:08x}", word);
    return text;
  }

  AVSHA* sha_;
  bool has_instructions_ = has_instructions();
  // FIPS 180-4, 5.3.3
  State state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::string rest_;  // of what was added, less than a block
  std::uint64_t bytes_ = 0;
};

}  // namespace

std::string checksum_of_text(std::string_view text) {
  Checksum checksum;
  checksum.add(text);
  return checksum.text();
}

Result<std::string> checksum_of_file(const fs::path& file, const std::atomic<bool>* cancel) {
  if (const Result<void> there = check_input_file(file); !there) return fail(there.error());
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(file.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::cannot_read);
  Checksum checksum;
  std::vector<char> piece(kPieceBytes);
  while (in) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    checksum.add({piece.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) return fail(file.string(), "cannot be read to its end", ErrorKind::cannot_read);
  return checksum.text();
}

std::string checksum_line(const std::string& checksum, const std::string& path) {
  std::string name;
  for (const char c : path) {
    if (c == '\\')
      name += "\\\\";
    else if (c == '\n')
      name += "\\n";
    else if (c == '\r')
      name += "\\r";
    else
      name += c;
  }
  return fmt::format("{}{}  {}\n", name == path ? "" : "\\", checksum, name);
}

}  // namespace sigs
