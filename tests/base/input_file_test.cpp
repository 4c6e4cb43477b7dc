// SPDX-License-Identifier: MIT

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/input_file.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

void make_socket(const fs::path& path) {
  const int socket_number = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{.sun_family = AF_UNIX};
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  REQUIRE(bind(socket_number, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  close(socket_number);
}

void check_refused(const fs::path& path, const std::string& word) {
  for (const Result<void>& refused : {check_input_file(path), [&] {
                                        const Result<std::string> text = read_text(path);
                                        return text ? Result<void>() : Result<void>(fail(text.error()));
                                      }()}) {
    REQUIRE_FALSE(refused);
    CHECK(refused.error().kind == ErrorKind::cannot_read);
    CHECK_MESSAGE(refused.error().what.find(word) != std::string::npos, refused.error().text());
  }
}

}  // namespace

TEST_CASE("a regular file and a link to one are read byte for byte") {
  const TemporaryFolder folder;
  const std::string bytes = std::string("a\r\n\0b\xFF", 6) + std::string(300'000, 'x');
  test::write_file(folder / "file", bytes);
  fs::create_symlink("file", folder / "link");
  CHECK(read_text(folder / "file").value() == bytes);
  CHECK(read_text(folder / "link").value() == bytes);
  test::write_file(folder / "empty", "");
  CHECK(read_text(folder / "empty").value().empty());
}

TEST_CASE("a missing file, a folder, a device, a pipe, a socket and a file of the kernel are named and not opened") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  make_socket(folder / "socket");
  fs::create_symlink("/dev/zero", folder / "link");
  fs::create_symlink("gone", folder / "dangling");
  check_refused(folder / "gone", "no such file");
  check_refused(folder / "dangling", "no such file");
  check_refused(folder.path(), "folder");
  check_refused("/dev/zero", "device");
  check_refused(folder / "link", "device");
  check_refused(folder / "pipe", "pipe");
  check_refused(folder / "socket", "socket");
  check_refused("/proc/self/status", "kernel");
  CHECK(check_input_file("/dev/zero", "image").error().what == "is a device, not an image; a regular file is needed");
  CHECK(check_input_file(folder.path(), "video").error().what == "is a folder, not a video");
  fs::create_symlink("/proc/kmsg", folder / "log");  // never ends
  check_refused(folder / "log", "kernel");
}

TEST_CASE("a file may be as large as its limit and no larger") {
  const TemporaryFolder folder;
  fs::resize_file((test::write_file(folder / "file", ""), folder / "file"), 2 * kMebibyte);
  CHECK(read_text(folder / "file", 2 * kMebibyte).value().size() == 2 * kMebibyte);
  const Result<std::string> larger = read_text(folder / "file", 2 * kMebibyte - 1);
  REQUIRE_FALSE(larger);
  CHECK(larger.error().kind == ErrorKind::bad_data);
  CHECK(larger.error().what.find("1 MiB") != std::string::npos);
}
