// SPDX-License-Identifier: GPL-3.0-or-later
// Place recognition on pictures that a vocabulary has not seen: precision and recall of its scores and, to
// compare with, of brute-force matching of all descriptors. Places are tiles of the pictures; queries are the
// same tiles seen otherwise (turned, tilted, cut, brighter or darker, noisy). Every second place is unknown
// to the database: whatever is recognised there is wrong.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "orbslam/io/image_file.h"
#include "orbslam/util/random.h"
#include "orbslam/vocabulary/keyframe_index.h"
#include "orbslam/vocabulary/training_images.h"
#include "orbslam/vocabulary/vocabulary_file.h"
#include "picture_files.h"

namespace orbslam {
namespace {

constexpr size_t kMinFeatures = 200;

struct Arguments {
  std::string vocabulary, csv;
  std::vector<std::string> folders;
  size_t max_places = 400;
  bool brute_force = false;
};

using Features = std::vector<Descriptor>;

struct Views {
  std::vector<Features> places;   // every second one is in the database
  std::vector<Features> queries;  // one a place
};

/// What a method thinks of a query: its best place in the database, how sure it is, and how many places it
/// ranks before the right one (all of them if it does not find it).
struct Answer {
  size_t place = 0;
  double score = 0;
  size_t rank_of_right = 0;
};

struct Scored {
  size_t place = 0;
  double score = 0;
};

Answer MakeAnswer(std::vector<Scored> ranking, size_t right) {
  if (ranking.empty()) return {0, 0, std::string::npos};
  std::ranges::stable_sort(ranking, std::greater{}, &Scored::score);
  const auto found = std::ranges::find(ranking, right, &Scored::place);
  const bool is_found = found != ranking.end() && found->score > 0;
  return {ranking[0].place, ranking[0].score,
          is_found ? static_cast<size_t>(found - ranking.begin()) : std::string::npos};
}

/// The tile as another camera may see it: a quadrilateral of it, turned by up to 15 degrees, with another
/// exposure and noise of 4 grey levels.
cv::Mat SeenOtherwise(const cv::Mat& tile, Rng* rng) {
  const auto width = static_cast<float>(tile.cols), height = static_cast<float>(tile.rows);
  const double turn = rng->Uniform(-15, 15) * CV_PI / 180;
  const auto turned = [&](double x, double y) {
    const double dx = (x - 0.5) * width, dy = (y - 0.5) * height;
    return cv::Point2f(static_cast<float>(width / 2 + dx * std::cos(turn) - dy * std::sin(turn)),
                       static_cast<float>(height / 2 + dx * std::sin(turn) + dy * std::cos(turn)));
  };
  const auto inset = [&] { return rng->Uniform(0.02, 0.2); };
  const std::vector<cv::Point2f> seen{turned(inset(), inset()), turned(1 - inset(), inset()),
                                      turned(1 - inset(), 1 - inset()), turned(inset(), 1 - inset())};
  const std::vector<cv::Point2f> corners{{0, 0}, {width, 0}, {width, height}, {0, height}};
  cv::Mat view;
  cv::warpPerspective(tile, view, cv::getPerspectiveTransform(seen, corners), tile.size(), cv::INTER_LINEAR,
                      cv::BORDER_REFLECT);
  const double gain = rng->Uniform(0.7, 1.3), offset = rng->Uniform(-20, 20);
  for (auto it = view.begin<uchar>(); it != view.end<uchar>(); ++it) {
    *it = cv::saturate_cast<uchar>(gain * *it + offset + 4 * rng->Gaussian());
  }
  return view;
}

Views MakeViews(const Arguments& arguments) {
  TileOptions one_scale;
  one_scale.max_image_side = 1920;
  one_scale.scale_step = 1e9;
  std::vector<cv::Mat> tiles;
  for (const std::string& file : FindPictures(arguments.folders)) {
    const Result<cv::Mat> image = ReadGray(file);
    if (!image) continue;
    std::vector<cv::Mat> cut = CutTiles(*image, one_scale);
    if (cut.size() > 1) cut.pop_back();  // the whole picture in one tile: it overlaps the others
    tiles.insert(tiles.end(), cut.begin(), cut.end());
  }
  Views views;
  OrbExtractor extractor({});
  Rng rng(1);
  const size_t step = std::max<size_t>(1, tiles.size() / arguments.max_places);
  for (size_t i = 0; i < tiles.size() && views.places.size() < arguments.max_places; i += step) {
    Features place = extractor.Extract(tiles[i]).descriptors;
    Features query = extractor.Extract(SeenOtherwise(tiles[i], &rng)).descriptors;
    if (std::min(place.size(), query.size()) < kMinFeatures) continue;
    views.places.push_back(std::move(place));
    views.queries.push_back(std::move(query));
  }
  return views;
}

std::vector<Answer> AskVocabulary(const Vocabulary& vocabulary, const Views& views) {
  KeyFrameIndex index;
  for (uint32_t i = 0; i < views.places.size(); i += 2) {
    index.Add(KeyFrameId(i), vocabulary.Transform(views.places[i], 0).bow);
  }
  std::vector<Answer> answers;
  for (const Features& query : views.queries) {
    std::vector<Scored> ranking;
    for (const auto& candidate : index.Query(vocabulary.Transform(query, 0).bow, {}, 0.0)) {
      ranking.push_back({candidate.id.value, candidate.score});
    }
    answers.push_back(MakeAnswer(std::move(ranking), answers.size()));
  }
  return answers;
}

/// Scores a place by the share of the query's features whose best match there is near and clearly the best.
std::vector<Answer> AskBruteForce(const Views& views) {
  std::vector<Answer> answers;
  for (const Features& query : views.queries) {
    std::vector<Scored> ranking;
    for (size_t i = 0; i < views.places.size(); i += 2) {
      const auto matches = std::ranges::count_if(query, [&](const Descriptor& descriptor) {
        const NearestTwo nearest = FindNearestTwo(descriptor, views.places[i]);
        return nearest.distance <= 50 && nearest.distance < 0.8 * nearest.second_distance;
      });
      ranking.push_back({i, static_cast<double>(matches) / static_cast<double>(query.size())});
    }
    answers.push_back(MakeAnswer(std::move(ranking), answers.size()));
  }
  return answers;
}

/// For how many of the known places the right answer is among the first N.
void ReportRanks(const std::string& method, const std::vector<Answer>& answers, std::ofstream* csv) {
  std::printf("%s: right place among the best", method.c_str());
  const double num_known = static_cast<double>((answers.size() + 1) / 2);
  for (const size_t best : {1, 2, 3, 5, 10, 20}) {
    double found = 0;
    for (size_t query = 0; query < answers.size(); query += 2)
      found += answers[query].rank_of_right < best ? 1 : 0;
    std::printf(" %zu: %.1f %%", best, 100 * found / num_known);
    if (csv->is_open()) *csv << method << ",rank," << best << ',' << found / num_known << '\n';
  }
  std::printf("\n");
}

/// Walks down the answers from the surest: recall and precision if only those up to there were believed.
void ReportPrecision(const std::string& method, const std::vector<Answer>& answers, std::ofstream* csv) {
  struct Judged {
    double score;
    bool is_right;
  };
  std::vector<Judged> judged;
  for (size_t query = 0; query < answers.size(); ++query) {
    judged.push_back({answers[query].score, answers[query].rank_of_right == 0});
  }
  std::ranges::stable_sort(judged, std::greater{}, &Judged::score);
  const double num_known = static_cast<double>((answers.size() + 1) / 2);
  double right = 0;
  for (size_t i = 0; i < judged.size(); ++i) {
    right += judged[i].is_right ? 1 : 0;
    if (!csv->is_open()) continue;
    *csv << method << ",precision," << right / num_known << ',' << right / static_cast<double>(i + 1) << '\n';
  }
}

void Report(const std::string& method, const std::vector<Answer>& answers, std::ofstream* csv) {
  ReportRanks(method, answers, csv);
  ReportPrecision(method, answers, csv);
}

int Measure(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Result<Vocabulary> vocabulary = ReadVocabulary(arguments.vocabulary);
  const std::chrono::duration<double, std::milli> opening = std::chrono::steady_clock::now() - start;
  if (!vocabulary) {
    std::fprintf(stderr, "measure_vocabulary: %s\n", vocabulary.error().message.c_str());
    return 1;
  }
  std::printf("%s: k %d, L %d, %d words, opened in %.1f ms\n", arguments.vocabulary.c_str(),
              vocabulary->branching(), vocabulary->depth(), vocabulary->num_words(), opening.count());
  const Views views = MakeViews(arguments);
  if (views.places.empty()) {
    std::fprintf(stderr, "measure_vocabulary: the folders hold no picture with enough corners\n");
    return 2;
  }
  std::printf("%zu places, every second one in the database\n", views.places.size());
  std::ofstream csv;
  if (!arguments.csv.empty()) csv.open(arguments.csv);
  if (csv.is_open()) csv << "method,curve,x,y\n";
  Report("vocabulary", AskVocabulary(*vocabulary, views), &csv);
  if (arguments.brute_force) Report("brute force", AskBruteForce(views), &csv);
  return 0;
}

}  // namespace
}  // namespace orbslam

int main(int argc, char** argv) {
  orbslam::Arguments arguments;
  CLI::App app{"Measure place recognition with a vocabulary on pictures that it was not trained on"};
  app.add_option("VOCABULARY", arguments.vocabulary)->required();
  app.add_option("IMAGES_DIR", arguments.folders, "folders with pictures")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--csv", arguments.csv, "write the curves: method, rank or precision, x, y");
  app.add_option("--max-places", arguments.max_places)->check(CLI::PositiveNumber)->capture_default_str();
  app.add_flag("--brute-force", arguments.brute_force, "also match all descriptors with all (minutes)");
  CLI11_PARSE(app, argc, argv);
  return orbslam::Measure(arguments);
}
