// SPDX-License-Identifier: BSD-3-Clause
// 32 characters of base64 at a time. Method: Mula and Lemire, "Faster Base64 Encoding and Decoding
// Using AVX2 Instructions", ACM Transactions on the Web 12 (2018) 20: two look-ups by the halves of
// a character tell whether it is of the alphabet, one what to add to make it its value.
#include "readers/base64.hpp"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace bedscope::readers::base64 {

#ifdef __x86_64__
namespace {

__attribute__((target("avx2"))) __m256i twice(long long high, long long low) {
  return _mm256_set_epi64x(high, low, high, low);
}

__attribute__((target("avx2"))) std::size_t decode_avx2(const unsigned char* from,
                                                        std::size_t chars, char* into,
                                                        std::size_t room) {
  // Byte k of a table belongs to the half-byte k; bits that both halves share forbid the character.
  const __m256i of_low = twice(0x1A1B1B1B1A131111, 0x1111111111111115);
  const __m256i of_high = twice(0x1010101010101010, 0x0804080402011010);
  const __m256i to_add = twice(0, static_cast<long long>(0xB9B9BFBF04131000));
  const __m256i slash = _mm256_set1_epi8('/');
  // Bytes of a group stand in the order of a big-endian number, 12 of 16.
  const __m256i order =
      twice(static_cast<long long>(0xFFFFFFFF0C0D0E08), static_cast<long long>(0x090A040506000102));
  const __m256i close_up = _mm256_setr_epi32(0, 1, 2, 4, 5, 6, 7, 7);
  std::size_t done = 0;
  for (; chars - done >= 32 && room - done / 4 * 3 >= 32; done += 32) {
    const __m256i text = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + done));
    const __m256i high = _mm256_and_si256(_mm256_srli_epi32(text, 4), slash);
    const __m256i low = _mm256_and_si256(text, slash);
    if (!_mm256_testz_si256(_mm256_shuffle_epi8(of_low, low), _mm256_shuffle_epi8(of_high, high)))
      break;
    const __m256i roll =
        _mm256_shuffle_epi8(to_add, _mm256_add_epi8(_mm256_cmpeq_epi8(text, slash), high));
    const __m256i values = _mm256_add_epi8(text, roll);  // 6 bits in each byte
    const __m256i pairs = _mm256_maddubs_epi16(values, _mm256_set1_epi32(0x01400140));
    const __m256i groups = _mm256_madd_epi16(pairs, _mm256_set1_epi32(0x00011000));
    const __m256i bytes = _mm256_permutevar8x32_epi32(_mm256_shuffle_epi8(groups, order), close_up);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(into + done / 4 * 3), bytes);
  }
  return done;
}

}  // namespace

std::size_t decode_blocks(const unsigned char* from, std::size_t chars, char* into,
                          std::size_t room) {
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return has_avx2 ? decode_avx2(from, chars, into, room) : 0;
}
#else
std::size_t decode_blocks(const unsigned char*, std::size_t, char*, std::size_t) { return 0; }
#endif

}  // namespace bedscope::readers::base64
