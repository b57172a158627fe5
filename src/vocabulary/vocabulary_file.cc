// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/vocabulary_file.h"

#include <string>
#include <string_view>
#include <utility>

#include "binary_format.h"
#include "orbslam/util/file.h"
#include "text_format.h"

namespace orbslam {
namespace {

Error In(const std::string& path, const std::string& what) { return Error{path + ": " + what}; }

Result<VocabularyTree> ReadTree(const std::string& path) {
  const Result<std::string> file = ReadFile(path);
  if (!file) return file.error();
  const std::string_view content = *file;
  if (content.empty()) return In(path, "not a vocabulary: the file is empty");
  if (content.starts_with(kBinaryMagic)) {
    Result<VocabularyTree> tree = ParseBinaryTree(content);
    if (!tree) return In(path, tree.error().message);
    return tree;
  }
  const std::string_view start = content.substr(0, content.find('\n'));
  if (start.find_first_not_of("0123456789 \t\r") == std::string_view::npos)
    return ParseTextTree(content, path);
  return In(path, "not a vocabulary: neither our binary format nor DBoW2's text");
}

}  // namespace

Result<Vocabulary> ReadVocabulary(const std::string& path) {
  Result<VocabularyTree> tree = ReadTree(path);
  if (!tree) return tree.error();
  Result<Vocabulary> vocabulary = Vocabulary::Create(*std::move(tree));
  if (!vocabulary) return In(path, vocabulary.error().message);
  return vocabulary;
}

Status WriteVocabulary(const Vocabulary& vocabulary, const std::string& path) {
  return WriteFileAtomically(path, FormatBinaryTree(vocabulary.tree()));
}

}  // namespace orbslam
