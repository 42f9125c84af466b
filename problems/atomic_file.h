#pragma once

#include <filesystem>
#include <span>

namespace conebench::problems {

/// Replaces `path` by `bytes` as one step: written to a temporary name in the same folder, synced,
/// renamed. A reader sees the old file or the new one, never a part.
/// Throws OutputError naming the file (no such folder, unwritable, disk full) and then leaves
/// nothing behind. A process with a file size limit must ignore SIGXFSZ to get the error.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Makes what was written to a file that is there safe from a crash. Throws OutputError.
void sync_file(const std::filesystem::path& path);
/// The same for what was created, renamed or removed in a folder, where its file system can.
void sync_folder(const std::filesystem::path& folder);

}  // namespace conebench::problems
