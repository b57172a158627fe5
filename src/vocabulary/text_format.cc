// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_format.h"

#include <charconv>
#include <optional>

namespace orbslam {
namespace {

struct TextNode {
  uint32_t parent = 0;
  bool is_leaf = false;
  Descriptor descriptor;
  float weight = 0;
  int line = 1;
};

/// Numbers of one line, separated by blanks.
class LineParser {
 public:
  explicit LineParser(std::string_view line) : rest_(line) {}

  template <class T>
  bool Take(T* value) {
    SkipBlanks();
    const auto [end, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), *value);
    if (code != std::errc{}) return false;
    rest_.remove_prefix(static_cast<size_t>(end - rest_.data()));
    return rest_.empty() || IsBlank(rest_.front());
  }
  bool AtEnd() {
    SkipBlanks();
    return rest_.empty();
  }

 private:
  static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void SkipBlanks() {
    while (!rest_.empty() && IsBlank(rest_.front())) rest_.remove_prefix(1);
  }
  std::string_view rest_;
};

/// Lines that are not blank, one after the other, with their number.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  std::optional<std::string_view> Next() {
    while (!rest_.empty()) {
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (!LineParser(line).AtEnd()) return line;
    }
    return std::nullopt;
  }
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

Error At(const std::string& name, int line, const std::string& what) {
  return Error{name + ":" + std::to_string(line) + ": " + what};
}

bool ParseHeader(std::string_view line, VocabularyTree* tree, int* scoring, int* weighting) {
  LineParser parser(line);
  return parser.Take(&tree->branching) && parser.Take(&tree->depth) && parser.Take(scoring) &&
         parser.Take(weighting) && parser.AtEnd() && tree->branching >= 2 && tree->branching <= 255 &&
         tree->depth >= 1 && tree->depth <= 32;
}

bool ParseNode(std::string_view line, TextNode* node) {
  LineParser parser(line);
  int leaf = 0;
  if (!parser.Take(&node->parent) || !parser.Take(&leaf) || leaf < 0 || leaf > 1) return false;
  node->is_leaf = leaf == 1;
  for (int i = 0; i < 32; ++i) {
    uint8_t byte = 0;
    if (!parser.Take(&byte)) return false;
    node->descriptor.words[i / 8] |= uint64_t{byte} << (8 * (i % 8));
  }
  return parser.Take(&node->weight) && node->weight >= 0 && parser.AtEnd();
}

/// All nodes in the order of the file behind the root, or what is wrong with the first line that is not one.
Result<std::vector<TextNode>> ParseNodes(LineReader& lines, const std::string& name) {
  std::vector<TextNode> nodes(1);
  while (const auto line = lines.Next()) {
    TextNode node;
    node.line = lines.number();
    if (!ParseNode(*line, &node)) return At(name, node.line, "expected `parent leaf b0 .. b31 weight`");
    if (node.parent >= nodes.size()) return At(name, node.line, "the parent does not come before its child");
    if (nodes[node.parent].is_leaf) return At(name, node.line, "the parent is a leaf");
    nodes.push_back(node);
  }
  return nodes;
}

/// The nodes' indices in breadth-first order; fills the tree's child counts in that order.
Result<std::vector<uint32_t>> BreadthFirst(const std::vector<TextNode>& nodes, const std::string& name,
                                           VocabularyTree* tree) {
  std::vector<std::vector<uint32_t>> children(nodes.size());
  for (uint32_t i = 1; i < nodes.size(); ++i) children[nodes[i].parent].push_back(i);
  std::vector<uint32_t> order{0};
  order.reserve(nodes.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const TextNode& node = nodes[order[i]];
    const std::vector<uint32_t>& own = children[order[i]];
    if (own.empty() && !node.is_leaf) {
      return At(
          name, node.line,
          "node " + std::to_string(order[i]) + " is not a leaf but has no children: the file is truncated");
    }
    if (own.size() > static_cast<size_t>(tree->branching)) {
      return At(name, node.line, "node " + std::to_string(order[i]) + " has more than k children");
    }
    order.insert(order.end(), own.begin(), own.end());
    tree->child_counts.push_back(static_cast<uint8_t>(own.size()));
  }
  return order;
}

}  // namespace

Result<VocabularyTree> ParseTextTree(std::string_view text, const std::string& name) {
  LineReader lines(text);
  const auto header = lines.Next();
  VocabularyTree tree;
  int scoring = 0, weighting = 0;
  if (!header || !ParseHeader(*header, &tree, &scoring, &weighting)) {
    return At(name, 1, "not a vocabulary: expected `k L scoring weighting`");
  }
  if (scoring != 0 || weighting != 0) {
    return At(name, 1, "only L1 scores and TF-IDF weights are supported (scoring 0, weighting 0)");
  }
  const Result<std::vector<TextNode>> nodes = ParseNodes(lines, name);
  if (!nodes) return nodes.error();
  const Result<std::vector<uint32_t>> order = BreadthFirst(*nodes, name, &tree);
  if (!order) return order.error();
  for (const uint32_t i : *order) {
    const TextNode& node = (*nodes)[i];
    tree.descriptors.push_back(node.descriptor);
    if (node.is_leaf) tree.word_weights.push_back(node.weight);
  }
  return tree;
}

}  // namespace orbslam
