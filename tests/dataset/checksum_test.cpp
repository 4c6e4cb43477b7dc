// SPDX-License-Identifier: MIT
#include "dataset/entry.h"

#include <doctest/doctest.h>

#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("checksums are those of FIPS 180-4's examples") {
  CHECK(checksum_of_text("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(checksum_of_text("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(checksum_of_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(checksum_of_text(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("checksums of every length around the ends of blocks are those of Python's hashlib") {
  std::string text;
  std::string checksums;
  for (int n = 0; n < 400; ++n) {
    checksums += checksum_of_text(text);
    text += static_cast<char>((n * 7 + n / 256) % 256);
  }
  CHECK(checksum_of_text(checksums) == "99f6d46c2c48d239af517ccb95e39758f544a3dc80e7778bdf7862aaa6ee31f7");
}

TEST_CASE("a file's checksum is that of its text, over any number of pieces") {
  const TemporaryFolder folder;
  for (const std::size_t bytes : {0UL, 1UL, (1UL << 20U) - 1, 1UL << 20U, (1UL << 20U) + 1, 3000000UL}) {
    const std::string text(bytes, 'x');
    write_file(folder / "file", text);
    CHECK(checksum_of_file(folder / "file").value() == checksum_of_text(text));
  }
}

TEST_CASE("a file that cannot be read is named, and a cancellation ends the work") {
  const TemporaryFolder folder;
  CHECK(checksum_of_file(folder / "none").error().kind == ErrorKind::cannot_read);
  CHECK(checksum_of_file(folder.path()).error().kind == ErrorKind::cannot_read);
  write_file(folder / "file", "text");
  const std::atomic<bool> stop{true};
  CHECK(checksum_of_file(folder / "file", &stop).error().kind == ErrorKind::interrupted);
}

TEST_CASE("lines of checksums are what sha256sum writes") {
  CHECK(checksum_line("00", "a b") == "00  a b\n");
  CHECK(checksum_line("00", "a\\b\nc") == "\\00  a\\\\b\\nc\n");
}
