// SPDX-License-Identifier: GPL-3.0-or-later
#include "quad_tree.h"

#include <algorithm>
#include <cmath>

namespace orbslam {
namespace {

struct Node {
  std::span<Corner> corners;
  cv::Rect area;
};

using Nodes = std::vector<Node>;

// Splits off the corners for which `first` holds; both parts are spans of the same memory.
template <class Predicate>
std::pair<std::span<Corner>, std::span<Corner>> Partition(std::span<Corner> corners, Predicate first) {
  const auto middle = std::partition(corners.begin(), corners.end(), first);
  const auto count = static_cast<size_t>(middle - corners.begin());
  return {corners.first(count), corners.subspan(count)};
}

void AddHalves(std::span<Corner> corners, const cv::Rect& area, Nodes* children) {
  const int left_width = area.width / 2;
  const int middle = area.x + left_width;
  const auto [left, right] = Partition(corners, [&](const Corner& c) { return c.x < middle; });
  if (!left.empty()) children->push_back({left, {area.x, area.y, left_width, area.height}});
  if (!right.empty()) children->push_back({right, {middle, area.y, area.width - left_width, area.height}});
}

void Split(const Node& node, Nodes* children) {
  const cv::Rect& area = node.area;
  const int top_height = area.height / 2;
  const int middle = area.y + top_height;
  const auto [top, bottom] = Partition(node.corners, [&](const Corner& c) { return c.y < middle; });
  AddHalves(top, {area.x, area.y, area.width, top_height}, children);
  AddHalves(bottom, {area.x, middle, area.width, area.height - top_height}, children);
}

// Nearly square roots side by side, along the longer side of the area.
Nodes MakeRoots(std::span<Corner> corners, const cv::Rect& area) {
  const bool wide = area.width >= area.height;
  const int length = wide ? area.width : area.height;
  const int count =
      std::max(1, static_cast<int>(std::lround(1.0 * length / (wide ? area.height : area.width))));
  Nodes roots;
  for (int i = 0; i < count; ++i) {
    const int begin = length * i / count, end = length * (i + 1) / count;
    const cv::Rect root = wide ? cv::Rect(area.x + begin, area.y, end - begin, area.height)
                               : cv::Rect(area.x, area.y + begin, area.width, end - begin);
    const int limit = wide ? root.x + root.width : root.y + root.height;
    const auto [inside, rest] =
        Partition(corners, [&](const Corner& c) { return (wide ? c.x : c.y) < limit; });
    if (!inside.empty()) roots.push_back({inside, root});
    corners = rest;
  }
  return roots;
}

void MoveSingles(Nodes* nodes, Nodes* leaves) {
  const auto is_single = [](const Node& node) { return node.corners.size() == 1; };
  std::copy_if(nodes->begin(), nodes->end(), std::back_inserter(*leaves), is_single);
  std::erase_if(*nodes, is_single);
}

Nodes GrowLeaves(Nodes generation, size_t wanted) {
  Nodes leaves, children;
  MoveSingles(&generation, &leaves);
  while (!generation.empty() && leaves.size() + generation.size() < wanted) {
    std::stable_sort(generation.begin(), generation.end(),
                     [](const Node& a, const Node& b) { return a.corners.size() > b.corners.size(); });
    children.clear();
    size_t split = 0;
    while (split < generation.size() &&
           leaves.size() + generation.size() - split + children.size() < wanted) {
      Split(generation[split++], &children);
    }
    leaves.insert(leaves.end(), generation.begin() + static_cast<std::ptrdiff_t>(split), generation.end());
    generation.swap(children);
    MoveSingles(&generation, &leaves);
  }
  leaves.insert(leaves.end(), generation.begin(), generation.end());
  return leaves;
}

}  // namespace

std::vector<Corner> SpreadByQuadTree(std::span<Corner> corners, const cv::Rect& area, int wanted) {
  std::vector<Corner> chosen;
  if (wanted <= 0 || corners.empty()) return chosen;
  const auto weaker = [](const Corner& a, const Corner& b) { return a.score < b.score; };
  for (const Node& leaf : GrowLeaves(MakeRoots(corners, area), static_cast<size_t>(wanted))) {
    chosen.push_back(*std::max_element(leaf.corners.begin(), leaf.corners.end(), weaker));
  }
  return chosen;
}

}  // namespace orbslam
