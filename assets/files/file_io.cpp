// SPDX-License-Identifier: MIT
#include "assets/files/file_io.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace ego {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string Reason(int code) { return std::generic_category().message(code); }

template <class Buffer>
Result<Buffer> ReadInto(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) return Error{path.string() + ": no such file"};
  if (fs::is_directory(status)) return Error{path.string() + ": is a folder, not a file"};
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) return Error{path.string() + ": cannot be opened: " + Reason(errno)};
  Buffer buffer;
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  // Grown block by block: the size that a file system reports is not to be trusted for pipes and
  // special files.
  while (true) {
    const std::size_t before = buffer.size();
    buffer.resize(before + kBlock);
    const std::size_t got = std::fread(buffer.data() + before, 1, kBlock, file.get());
    buffer.resize(before + got);
    if (buffer.size() > kMaxFileSize) {
      return Error{path.string() + ": is larger than 2 GiB, which no take or character is"};
    }
    if (got < kBlock) break;
  }
  if (std::ferror(file.get())) return Error{path.string() + ": cannot be read: " + Reason(errno)};
  return buffer;
}

}  // namespace

Result<std::vector<std::uint8_t>> ReadFile(const fs::path& path) {
  return ReadInto<std::vector<std::uint8_t>>(path);
}

Result<std::string> ReadTextFile(const fs::path& path) { return ReadInto<std::string>(path); }

Result<void> WriteFileAtomically(const fs::path& path, std::span<const std::uint8_t> bytes) {
  fs::path temporary = path;
  temporary += ".tmp" + std::to_string(getpid());
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0) return Error{path.string() + ": cannot be written: " + Reason(errno)};
  int failure = 0;
  for (std::size_t done = 0; done < bytes.size() && failure == 0;) {
    const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
    if (n >= 0) {
      done += static_cast<std::size_t>(n);
    } else if (errno != EINTR) {
      failure = errno;
    }
  }
  if (failure == 0 && fsync(file) != 0) failure = errno;
  if (close(file) != 0 && failure == 0) failure = errno;
  if (failure == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) failure = errno;
  if (failure == 0) return {};
  std::remove(temporary.c_str());
  return Error{path.string() + ": cannot be written: " + Reason(failure)};
}

Result<void> WriteFileAtomically(const fs::path& path, std::string_view text) {
  return WriteFileAtomically(
      path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace ego
