// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/settings.h"

#include <gmock/gmock.h>

#include <opencv2/core/persistence.hpp>

#include "orbslam/util/file.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string ConfigPath(const std::string& name) {
  return std::string(ORBSLAM_SOURCE_DIR) + "/config/" + name;
}

Settings ReadConfig(const std::string& name) {
  std::vector<std::string> warnings;
  const Result<Settings> settings = ReadSettings(ConfigPath(name), &warnings);
  EXPECT_TRUE(settings.ok()) << settings.error().message;
  EXPECT_THAT(warnings, IsEmpty());
  return *settings;
}

/// The error of TUM1.yaml after one replacement; empty if there is none.
std::string ErrorAfter(const std::string& old_text, const std::string& new_text) {
  const TempDir dir;
  std::string yaml = *ReadFile(ConfigPath("TUM1.yaml"));
  EXPECT_NE(yaml.find(old_text), std::string::npos) << old_text;
  yaml.replace(yaml.find(old_text), old_text.size(), new_text);
  const Result<Settings> settings = ReadSettings(dir.Write("changed.yaml", yaml), nullptr);
  return settings.ok() ? "" : settings.error().message;
}

TEST(Settings, OurFilesHoldThePublishedFigures) {
  struct Expected {
    const char* name;
    double fx, fy, cx, cy;
    std::array<double, 5> distortion;  // k1 k2 p1 p2 k3
    double units_per_metre;
  };
  const std::vector<Expected> files = {
      {"TUM1.yaml",
       517.306408,
       516.469215,
       318.643040,
       255.313989,
       {0.262383, -0.953104, -0.005358, 0.002628, 1.163314},
       5000},
      {"TUM2.yaml",
       520.908620,
       521.007327,
       325.141442,
       249.701764,
       {0.231222, -0.784899, -0.003257, -0.000105, 0.917205},
       5208},
      {"TUM3.yaml", 535.4, 539.2, 320.1, 247.6, {}, 5000},
      {"Bonn.yaml",
       542.822841,
       542.576870,
       315.593520,
       237.756098,
       {0.039903, -0.099343, -0.000730, -0.000144, 0},
       5000},
  };
  for (const Expected& expected : files) {
    const Settings settings = ReadConfig(expected.name);
    EXPECT_EQ(settings.camera.fx, expected.fx) << expected.name;
    EXPECT_EQ(settings.camera.fy, expected.fy) << expected.name;
    EXPECT_EQ(settings.camera.cx, expected.cx) << expected.name;
    EXPECT_EQ(settings.camera.cy, expected.cy) << expected.name;
    EXPECT_EQ(settings.camera.distortion, expected.distortion) << expected.name;
    EXPECT_EQ(settings.depth.units_per_metre, expected.units_per_metre) << expected.name;
    EXPECT_EQ(settings.depth.baseline_times_fx, 40);
    EXPECT_EQ(settings.depth.close_limit_baselines, 40);
    EXPECT_EQ(settings.camera.width, 640);
    EXPECT_EQ(settings.camera.height, 480);
    EXPECT_EQ(settings.fps, 30);
    EXPECT_EQ(settings.orb.num_features, 1000);
    EXPECT_EQ(settings.orb.scale_factor, 1.2);
    EXPECT_EQ(settings.orb.num_levels, 8);
    EXPECT_EQ(settings.orb.fast_threshold, 20);
    EXPECT_EQ(settings.orb.min_fast_threshold, 7);
  }
}

TEST(Settings, OpenCvReadsOurFilesToo) {
  for (const char* name : {"TUM1.yaml", "TUM2.yaml", "TUM3.yaml", "Bonn.yaml"}) {
    const cv::FileStorage file(ConfigPath(name), cv::FileStorage::READ);
    EXPECT_EQ(static_cast<double>(file["Camera.fx"]), ReadConfig(name).camera.fx);
    EXPECT_EQ(static_cast<int>(file["ORBextractor.nFeatures"]), 1000);
  }
}

TEST(Settings, EffectiveSettingsReadBackEqual) {
  const TempDir dir;
  Settings settings = ReadConfig("TUM2.yaml");
  settings.camera.width = 321;
  settings.fps = 0.1 + 0.2;
  settings.orb.min_fast_threshold = 1;
  const std::string yaml = EffectiveSettingsYaml(settings);
  std::vector<std::string> warnings;
  const Result<Settings> read = ReadSettings(dir.Write("effective.yaml", yaml), &warnings);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_EQ(EffectiveSettingsYaml(*read), yaml);
  EXPECT_EQ(read->camera.width, 321);
  EXPECT_EQ(read->fps, settings.fps);
  EXPECT_EQ(read->camera.distortion, settings.camera.distortion);
  EXPECT_THAT(yaml, HasSubstr("DepthMapFactor: 5208  # units of the depth image in a metre"));
}

TEST(Settings, WhatMayBeLeftOutIsAndTheRestIsNot) {
  for (const char* key :
       {"Camera.width: 640", "Camera.height: 480", "Camera.k1: 0.262383", "Camera.k3: 1.163314",
        "Camera.readout: 0.02611", "Camera.fps: 30.0", "Camera.RGB: 1"}) {
    EXPECT_EQ(ErrorAfter(key, ""), "");
  }
  for (const std::string key : {"Camera.fx", "Camera.fy", "Camera.cx", "Camera.cy", "Camera.bf", "ThDepth",
                                "DepthMapFactor", "ORBextractor.nFeatures", "ORBextractor.scaleFactor",
                                "ORBextractor.nLevels", "ORBextractor.iniThFAST", "ORBextractor.minThFAST"}) {
    EXPECT_THAT(ErrorAfter("\n" + key, "\nelse"),
                HasSubstr("changed.yaml: " + key + " is missing, expected a"));
  }
}

TEST(Settings, SectionsOfTheStagesAreOptionalAndReachTheirOptions) {
  const TempDir dir;
  const std::string yaml = *ReadFile(ConfigPath("TUM3.yaml")) +
                           "Tracking.minInliers: 33\nLocalMapping.maxBundleKeyFrames: 12\n"
                           "LoopClosing:\n  enabled: 0\n  minInliers: 25\n"
                           "DynamicDetector.mode: paper\nDynamicDetector.useGrowth: 0\n";
  std::vector<std::string> warnings;
  const Result<Settings> settings = ReadSettings(dir.Write("a.yaml", yaml), &warnings);
  ASSERT_TRUE(settings.ok()) << settings.error().message;
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_EQ(settings->tracking.min_local_inliers, 33);
  EXPECT_EQ(settings->mapping.max_bundle_keyframes, 12);
  EXPECT_EQ(settings->mapping.max_bundle_fixed, MappingOptions().max_bundle_fixed);
  EXPECT_FALSE(settings->closes_loops);
  EXPECT_EQ(settings->loops.min_inliers, 25);
  EXPECT_EQ(settings->detector.mode, DetectorMode::kPaper);
  EXPECT_FALSE(settings->detector.growth.use_growth);
  EXPECT_THAT(EffectiveSettingsYaml(*settings), HasSubstr("DynamicDetector.mode: \"paper\""));
}

TEST(Settings, ValuesOutOfRangeAreNamed) {
  EXPECT_THAT(ErrorAfter("DepthMapFactor: 5000.0", "DepthMapFactor: 0"),
              HasSubstr("DepthMapFactor: found '0'"));
  EXPECT_THAT(ErrorAfter("Camera.fx: 5", "Camera.fx: -5"), HasSubstr("Camera.fx: found '-5"));
  EXPECT_THAT(ErrorAfter("nFeatures: 1000", "nFeatures: 49"),
              HasSubstr("expected a whole number in [50, 20000]"));
  EXPECT_THAT(ErrorAfter("scaleFactor: 1.2", "scaleFactor: 1.0"), HasSubstr("expected a number in (1, 2]"));
  EXPECT_THAT(ErrorAfter("nLevels: 8", "nLevels: 17"), HasSubstr("expected a whole number in [1, 16]"));
  EXPECT_THAT(ErrorAfter("iniThFAST: 20", "iniThFAST: 256"),
              HasSubstr("expected a whole number in [1, 255]"));
  EXPECT_THAT(ErrorAfter("iniThFAST: 20", "iniThFAST: 6"), HasSubstr("minThFAST: found 7, expected at most"));
}

TEST(Settings, KeysOfOthersAreAcceptedAndSlipsOfThePenSuggested) {
  const TempDir dir;
  const std::string yaml = *ReadFile(ConfigPath("TUM3.yaml")) + "Viewer.KeyFrameSize: 0.05\nCamera.fsp: 25\n";
  std::vector<std::string> warnings;
  ASSERT_TRUE(ReadSettings(dir.Write("a.yaml", yaml), &warnings).ok());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("unknown key Camera.fsp is ignored; is Camera.fps meant?")));
}

TEST(Settings, NearPointsAreDoubtedWhereSomethingIsMeantToMove) {
  Settings settings;
  EXPECT_TRUE(DoubtsNearPoints(settings, true, false));
  EXPECT_TRUE(DoubtsNearPoints(settings, false, true));
  EXPECT_FALSE(DoubtsNearPoints(settings, false, false)) << "as ORB-SLAM2";
  settings.detects_motion = false;
  EXPECT_FALSE(DoubtsNearPoints(settings, true, false));
  EXPECT_TRUE(DoubtsNearPoints(settings, true, true));
  settings.detects_motion = true;
  settings.detector.mode = DetectorMode::kPaper;
  EXPECT_FALSE(DoubtsNearPoints(settings, true, true)) << "as published";
  settings.detector.mode = DetectorMode::kFull;
  settings.doubts_near_points = false;
  EXPECT_FALSE(DoubtsNearPoints(settings, true, true));
}

}  // namespace
}  // namespace orbslam
