// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace orbslam {
namespace {

Error FileError(const std::string& path, const std::string& what, int error_number) {
  return {path + ": " + what + ": " + std::generic_category().message(error_number)};
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { Close(); }

  int get() const { return fd_; }
  /// False with errno set if the system had kept back a failed write until now.
  bool Close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

bool WriteAll(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd, content.data(), content.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) content.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

Status WriteInPlace(const std::string& path, std::string_view content) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) return FileError(path, "cannot write", errno);
  if (!WriteAll(file.get(), content) || !file.Close()) return FileError(path, "cannot write", errno);
  return OkStatus();
}

/// A name that no other writer, in this process or another, uses at the same time.
std::string TemporaryName(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  return path + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
}

Status WriteBesideAndRename(const std::string& path, std::string_view content) {
  const std::string temporary = TemporaryName(path);
  FileDescriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.get() < 0) return FileError(path, "cannot write", errno);
  if (WriteAll(file.get(), content) && file.Close() && std::rename(temporary.c_str(), path.c_str()) == 0) {
    return OkStatus();
  }
  const int error_number = errno;
  ::unlink(temporary.c_str());
  return FileError(path, "cannot write", error_number);
}

}  // namespace

Result<std::string> ReadFile(const std::string& path, size_t max_bytes) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return FileError(path, "cannot open", errno);
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) return FileError(path, "cannot read", errno);
  if (S_ISDIR(info.st_mode)) return FileError(path, "cannot read", EISDIR);

  std::string content;
  size_t size = 0;
  while (size <= max_bytes) {
    // A pipe has no size; the one byte more lets a regular file's end be seen by the second read.
    const size_t expected = size == 0 ? static_cast<size_t>(info.st_size) : size;
    if (size == content.size()) content.resize(size + std::min(expected, max_bytes) + 1);
    const ssize_t count = ::read(file.get(), content.data() + size, content.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return FileError(path, "cannot read", errno);
    if (count == 0) {
      content.resize(size);
      return content;
    }
    size += static_cast<size_t>(count);
  }
  return Error{path + ": larger than " + std::to_string(max_bytes) + " bytes"};
}

Status WriteFileAtomically(const std::string& path, std::string_view content) {
  namespace fs = std::filesystem;
  std::error_code ignored;  // what cannot be looked at cannot be written: the open below says why
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) return FileError(path, "cannot write", EISDIR);
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status)) return WriteInPlace(path, content);
    if (::access(path.c_str(), W_OK) != 0) return FileError(path, "cannot write", errno);
  }
  if (!fs::is_symlink(fs::symlink_status(path, ignored))) return WriteBesideAndRename(path, content);
  return WriteBesideAndRename(fs::weakly_canonical(path, ignored).string(), content);
}

}  // namespace orbslam
