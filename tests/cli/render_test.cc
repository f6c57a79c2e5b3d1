// SPDX-License-Identifier: Apache-2.0
// Driving the renderer: strips, sequences that are kept, continued and redrawn, videos, and what is
// refused before anything is drawn.
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class RenderTest : public ProgramTest {
 protected:
  void expect_render_refusal(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& texts) const {
    expect_refusal(
        std::vector<std::string>{"render", "--preset", "earth-clear", "--out", "frame.png"} +
            arguments,
        texts);
  }
  // Of a drawn file, to see that it is not written again.
  fs::file_time_type time_of(const std::string& name) const {
    return fs::last_write_time(folder_ / name);
  }
};

TEST_F(RenderTest, AStripStandsSideBySide) {
  const Outcome outcome =
      run({"render", "--preset", "earth-clear", "--strip", "mie.scattering=1e-5..3e-5:3", "--view",
           "space", "--size", "32x18", "--samples-per-side", "1", "--stats", "--out", "strip.png"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("mie.scattering [1/m]"));
  EXPECT_THAT(outcome.out, HasSubstr("  1  2e-05"));
  EXPECT_THAT(outcome.out, HasSubstr("frame ms"));
  EXPECT_THAT(outcome.out, HasSubstr("median"));
  // IHDR: 3 x 32 and two gaps of 4 wide
  EXPECT_EQ(read("strip.png").substr(16, 8), std::string("\0\0\0\x68\0\0\0\x12", 8));
}

// What draws is named once: with the statistics, else on stderr where one did not ask for quiet.
TEST_F(RenderTest, TheDeviceIsNamedWhereItIsAskedFor) {
  const auto drawn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "render", "--preset", "earth-clear", "--model", "hillaire", "--table-size",
        "tiny",   "--view",   "space",       "--size",  "32x18",    "--samples-per-side",
        "1",      "--out",    "space.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  };
  const std::string by_egl = "drawn with .+, OpenGL 4\\..+, by EGL .+\n";
  EXPECT_THAT(drawn({"--gpu"}).err, MatchesRegex("skyfit: " + by_egl));
  EXPECT_EQ(drawn({"--gpu", "--quiet"}).err, "");
  const Outcome counted = drawn({"--gpu", "--stats"});
  EXPECT_EQ(counted.err, "");
  EXPECT_THAT(counted.out, ContainsRegex(by_egl));
  EXPECT_EQ(drawn({}).err, "");
  EXPECT_THAT(drawn({"--verbose"}).err, HasSubstr(", by OSMesa\n"));
}

// Rows one below the other, from one set of tables; the numbers are in the EXR, too.
TEST_F(RenderTest, AGridIsOnePicture) {
  const Outcome outcome = run({"render",
                               "--preset",
                               "earth-clear",
                               "--model",
                               "hillaire",
                               "--table-size",
                               "tiny",
                               "--strip",
                               "sun-zenith-deg=20..80:3:geometric",
                               "--rows",
                               "altitude-m=9e6,2e7",
                               "--view",
                               "space",
                               "--size",
                               "32x18",
                               "--samples-per-side",
                               "1",
                               "--metering",
                               "each",
                               "--out",
                               "grid.png",
                               "--out",
                               "grid.exr"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("from left to right, sun-zenith-deg [deg]"));
  EXPECT_THAT(outcome.out, HasSubstr("from top to bottom, altitude-m [m]:\n    0  9000000\n"));
  // IHDR: 3 x 32 and two gaps of 4 wide, 2 x 18 and a gap high
  EXPECT_EQ(read("grid.png").substr(16, 8), std::string("\0\0\0\x68\0\0\0\x28", 8));
  const std::string exr = read("grid.exr");
  EXPECT_THAT(exr, HasSubstr("sun-zenith-deg [deg]: 20, 40, 80"));
  EXPECT_THAT(exr, HasSubstr("altitude-m [m]: 9000000, 20000000"));
  EXPECT_THAT(exr, HasSubstr("skyfit:exposures_m2_per_cd"));
}

constexpr const char* kSequence = R"({"skyfit_sequence": 1, "frames_per_second": 10, "keyframes": [
  {"time_s": 0, "camera": {"view": "space"}, "sun": {"zenith_deg": 40}},
  {"time_s": 0.2, "sun": {"zenith_deg": 60}, "parameters": {"ground.albedo": 0.12}}]})";

TEST_F(RenderTest, ASequenceIsKeptContinuedAndRedrawn) {
  write("day.json", kSequence);
  const std::vector<std::string> command = {
      "render", "--preset",     "earth-clear", "--sequence", "day.json",
      "--size", "33x18",        "--out-dir",   "film",       "--samples-per-side",
      "1",      "--table-size", "tiny"};
  const std::string nowhere = "PATH=" + (folder_ / "no-programs").string();

  const Outcome first = run(command, {nowhere});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("film: 3 frames at 10 per second, 3 drawn, 0 kept"));
  EXPECT_EQ(lines(first.err).size(), 1u);
  EXPECT_THAT(first.err, HasSubstr("no ffmpeg in PATH"));
  EXPECT_THAT(first.err, HasSubstr("libx264"));
  EXPECT_THAT(files(), ::testing::UnorderedElementsAre("day.json", "film", "film/frame_00000.png",
                                                       "film/frame_00001.png",
                                                       "film/frame_00002.png", "film/frames.json"));

  // Nothing is drawn again, and the film is made once there is a program for it.
  const auto drawn = time_of("film/frame_00001.png");
  const std::string bytes = read("film/frame_00001.png"), manifest = read("film/frames.json");
  fs::permissions(write("programs/ffmpeg",
                        "#!/bin/sh\nfor last; do :; done\necho \"$@\" >\"$0.arguments\"\n"
                        "printf '\\000\\000\\000\\010moov' >\"$last\"\n"),
                  fs::perms::owner_all);
  const std::string programs = "PATH=" + (folder_ / "programs").string();
  const Outcome second = run(command, {programs});
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(second.err, "");
  EXPECT_THAT(second.out, HasSubstr("0 drawn, 3 kept, video film/sequence.mp4"));
  EXPECT_EQ(time_of("film/frame_00001.png"), drawn);
  EXPECT_EQ(read("film/sequence.mp4").size(), 8u);
  EXPECT_THAT(read("programs/ffmpeg.arguments"), HasSubstr("-framerate 10"));
  EXPECT_THAT(read("programs/ffmpeg.arguments"), HasSubstr("-i frame_%05d.png"));

  // A run that was cut off after two frames: the third comes out as it would have.
  const auto film = time_of("film/sequence.mp4");
  const std::string last = read("film/frame_00002.png");
  auto cut = nlohmann::ordered_json::parse(manifest);
  cut["frames"].erase("frame_00002");
  write("film/frames.json", cut.dump());
  fs::remove(folder_ / "film/frame_00002.png");
  const Outcome third = run(command, {programs});
  EXPECT_THAT(third.out, HasSubstr("1 drawn, 2 kept"));
  EXPECT_EQ(time_of("film/frame_00001.png"), drawn);
  EXPECT_EQ(read("film/frame_00002.png"), last);
  EXPECT_GE(time_of("film/sequence.mp4"), film);

  // Another tone curve makes other pictures.
  const Outcome fourth =
      run(command + std::vector<std::string>{"--tone", "exponential"}, {nowhere});
  EXPECT_THAT(fourth.out, HasSubstr("3 drawn, 0 kept"));
  EXPECT_NE(read("film/frame_00001.png"), bytes);

  // And so does other light.
  const Outcome fifth = run(command + std::vector<std::string>{"--orders", "1"}, {nowhere});
  EXPECT_THAT(fifth.out, HasSubstr("3 drawn, 0 kept"));
}

// The statistics say what each frame did for the tables that are renewed over frames.
TEST_F(RenderTest, TablesAreRenewedOverFrames) {
  write("fog.json", R"({"skyfit_sequence": 1, "frames_per_second": 10, "keyframes": [
      {"time_s": 0, "camera": {"view": "space"}},
      {"time_s": 0.2, "parameters": {"mie.scattering": 3e-5}}]})");
  const std::vector<std::string> command = {
      "render",    "--preset", "bodare-2014",     "--sequence", "fog.json", "--model", "bodare",
      "--out-dir", "film",     "--update-frames", "2",          "--size",   "32x18",   "--stats"};
  const std::string nowhere = "PATH=" + (folder_ / "no-programs").string();
  const Outcome first = run(command, {nowhere});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("table update ms"));
  EXPECT_THAT(first.out, HasSubstr("update of tables"));
  EXPECT_THAT(first.out, HasSubstr("3 drawn, 0 kept"));
  EXPECT_THAT(run(command, {nowhere}).out, HasSubstr("0 drawn, 3 kept"));
}

TEST_F(RenderTest, AFailingFfmpegIsNamed) {
  write("one.json", R"({"skyfit_sequence": 1, "keyframes": [{"time_s": 0}]})");
  fs::permissions(write("programs/ffmpeg", "#!/bin/sh\necho 'no such encoder' >&2\nexit 3\n"),
                  fs::perms::owner_all);
  const Outcome outcome = run({"render", "--preset", "earth-clear", "--sequence", "one.json",
                               "--size", "16x9", "--samples-per-side", "1", "--out-dir", "film"},
                              {"PATH=" + (folder_ / "programs").string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(
      outcome.err,
      HasSubstr("film/sequence.mp4: cannot be written: ffmpeg: exit status 3: no such encoder"));
  EXPECT_FALSE(fs::exists(folder_ / "film/sequence.mp4"));
  EXPECT_TRUE(fs::exists(folder_ / "film/frame_00000.png"));
}

TEST_F(RenderTest, HalfAFilmIsNoFilm) {
  write("one.json", R"({"skyfit_sequence": 1, "keyframes": [{"time_s": 0}]})");
  fs::permissions(write("programs/ffmpeg",
                        "#!/bin/sh\nfor last; do :; done\n"
                        "printf '\\000\\000\\000\\010moov\\000\\000\\001\\000mdat' >\"$last\"\n"),
                  fs::perms::owner_all);
  write("film/sequence.mp4", "the old one");
  const Outcome outcome = run({"render", "--preset", "earth-clear", "--sequence", "one.json",
                               "--size", "16x9", "--samples-per-side", "1", "--out-dir", "film"},
                              {"PATH=" + (folder_ / "programs").string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("film/sequence.mp4: cannot be written: ffmpeg left half"));
  EXPECT_EQ(read("film/sequence.mp4"), "the old one");
}

TEST_F(RenderTest, CamerasThatCannotBe) {
  const auto at_a_place = [](std::vector<std::string> more) {
    return std::vector<std::string>{"--latitude-deg", "47", "--longitude-deg", "8"} + more;
  };
  expect_render_refusal({"--latitude-deg", "91", "--longitude-deg", "0"},
                        {"--latitude-deg", "91", "-90 to 90"});
  expect_render_refusal({"--latitude-deg", "47"}, {"--latitude-deg", "with --longitude-deg"});
  expect_render_refusal({"--altitude-m", "1e300"}, {"--altitude-m", "1e300", "1e+09"});
  expect_render_refusal({"--altitude-m", "-5"}, {"--altitude-m", "-5"});
  expect_render_refusal({"--altitude-m", "5", "--above-ground-m", "5"},
                        {"--altitude-m", "without --above-ground-m"});
  expect_render_refusal({"--above-ground-m", "0"}, {"--above-ground-m", "0.1"});
  expect_render_refusal({"--heading-deg", "90"}, {"--heading-deg", "--latitude-deg"});
  expect_render_refusal(at_a_place({"--heading-deg", "north"}), {"--heading-deg", "north"});
  expect_render_refusal({"--pitch-deg", "95"}, {"--pitch-deg", "95", "-90 to 90"});
  expect_render_refusal({"--look-at", "1,2,3"}, {"--look-at", "--latitude-deg"});
  expect_render_refusal(at_a_place({"--look-at", "1,2"}), {"--look-at", "LATITUDE"});
  expect_render_refusal(at_a_place({"--look-at", "47,8,10", "--altitude-m", "10"}), {"look_at"});
  expect_render_refusal(at_a_place({"--look-at", "47,9,0", "--pitch-deg", "1"}),
                        {"--look-at", "without --pitch-deg"});
  expect_render_refusal({"--size", "100000x100000"}, {"--size", "100000x100000"});
  expect_render_refusal({"--size", "0x0"}, {"--size", "0x0"});
}

TEST_F(RenderTest, ScenesThatCannotBe) {
  expect_render_refusal({"--height-map", "missing.png"},
                        {"missing.png: cannot be read", "--height-map", "No such"});
  write("heights.png", "");
  expect_render_refusal({"--color-map", "heights.png"}, {"--color-map", "with --height-map"});
  expect_render_refusal({"--height-map", "heights.png", "--color-map", "."},
                        {".: cannot be read", "--color-map", "directory"});
  expect_render_refusal({"--height-map", "heights.png", "--height-range-m", "9000..0"},
                        {"--height-range-m", "LOW < HIGH"});
  expect_render_refusal({"--height-map", "heights.png", "--height-range-m", "9000"},
                        {"--height-range-m", "LOW..HIGH"});
  expect_render_refusal({"--height-range-m", "0..1"}, {"--height-range-m", "with --height-map"});
  expect_render_refusal({"--water-level-m", "-3"}, {"--water-level-m", "with --height-map"});
  expect_render_refusal({"--height-map", "heights.png", "--water-level-m", "-1e6"},
                        {"--water-level-m", "-1e6"});
  write("N46E007.hgt", "short");
  expect_render_refusal({"--height-map", "N46E007.hgt"}, {"--height-map", "--dem reads"});
  expect_render_refusal({"--dem", "missing.tif"}, {"missing.tif: cannot be read", "--dem"});
  expect_render_refusal({"--dem", "missing.tif@2"}, {"missing.tif: cannot be read", "--dem"});
  expect_render_refusal({"--dem", "N46E007.hgt@0"}, {"--dem", "FILE@BAND", "from 1 on"});
  expect_render_refusal({"--dem", "N46E007.hgt"}, {"N46E007.hgt: cannot be read: expected a name"});
  expect_render_refusal({"--dem", "heights.png"},
                        {"heights.png: cannot be read: expected a GeoTIFF or an .hgt of SRTM"});
  expect_render_refusal({"--dem", "heights.png", "--dem-surroundings", "lava"},
                        {"--dem-surroundings", "lava", "planet or sea"});
  expect_render_refusal({"--dem", "heights.png", "--dem-edge-m", "-5"},
                        {"--dem-edge-m \"-5\"", "0 to"});
  expect_render_refusal({"--dem-edge-m", "100"}, {"--dem-edge-m", "with --dem"});
  expect_render_refusal({"--mesh", "tower.obj"}, {"--mesh", "tower.obj", "FILE@LATITUDE"});
  expect_render_refusal({"--mesh", "tower.obj@47,8,0"},
                        {"tower.obj: cannot be read", "--mesh", "No such"});
  expect_render_refusal({"--moon", "10"}, {"--moon", "10", "ZENITH"});
  expect_render_refusal({"--moon", "10,20,30,40"},
                        {"--moon \"10,20,30,40\"", "moon.distance_m", "30"});
  expect_render_refusal({"--second-sun", "10,20,-1"},
                        {"--second-sun \"10,20,-1\"", "second_sun.irradiance", "-1"});
  const std::string second = "--second-sun=10,20,0.5", hot = "--second-sun-temperature-k";
  expect_render_refusal({second, hot, "500"}, {hot + " \"500\"", "1000 to 100000 K"});
  expect_render_refusal({hot, "5000"}, {hot, "with --second-sun"});
  expect_render_refusal({second, "--second-sun-spectrum", "nowhere.csv"}, {"nowhere.csv"});
  write("dark.csv", "wavelength_nm,irradiance_w_m2_nm\n300,0\n900,0\n");
  expect_render_refusal({second, "--second-sun-spectrum", "dark.csv"},
                        {"--second-sun-spectrum", "dark.csv", "between 380 and 780 nm"});
  expect_render_refusal({"--moonlight"}, {"--moonlight", "with --moon"});
  expect_render_refusal({"--moon", "10,20", "--moonlight", second},
                        {"--moonlight", "without --second-sun"});
  expect_render_refusal({"--moon", "10,20,4e8,1e8", "--moonlight"},
                        {"--moon \"10,20,4e8,1e8\"", "moon.radius_m", "10 degrees"});
  expect_render_refusal({"--clouds", "2"}, {"--clouds \"2\"", "clouds.cover", "2"});
  expect_render_refusal({"--aerial", "fog"}, {"--aerial", "fog", "pixel or volume"});
  expect_render_refusal({"--tone", "sepia"}, {"--tone", "sepia", "filmic, exponential or clip"});
  expect_render_refusal({"--exposure", "0"}, {"--exposure", "0", "m^2/cd"});
  expect_render_refusal({"--layers"}, {"--layers", ".exr"});
}

TEST_F(RenderTest, SequencesAndStripsThatCannotBe) {
  const std::vector<std::string> day = {
      "render",          "--preset", "earth-clear", "--latitude-deg", "47",
      "--longitude-deg", "8",        "--date",      "2026-06-21",     "--time"};
  expect_refusal(day + std::vector<std::string>{"05:00..21:00"}, {"--out-dir"});
  expect_refusal(day + std::vector<std::string>{"05:00..21:00", "--out", "x.png"},
                 {"--out", "--out-dir for a sequence"});
  expect_refusal(day + std::vector<std::string>{"05:00..25:00", "--out-dir", "x"},
                 {"--time", "05:00..25:00", "HH:MM"});
  expect_refusal(day + std::vector<std::string>{"05:00", "--out-dir", "x"},
                 {"--out-dir", "expected a sequence"});
  expect_refusal(day + std::vector<std::string>{"05:00", "--frames", "4", "--out", "x.png"},
                 {"--frames", "FROM..TO"});
  expect_refusal(day + std::vector<std::string>{"05:00..21:00", "--frames", "0", "--out-dir", "x"},
                 {"--frames", "0", "1 to 100000"});
  expect_refusal(
      day + std::vector<std::string>{"05:00..21:00", "--step-min", "-1", "--out-dir", "x"},
      {"--step-min", "-1"});
  expect_render_refusal({"--date", "2026-06-21", "--time", "12:00"}, {"--date", "--latitude-deg"});
  expect_render_refusal({"--date", "2026-06-21"}, {"--date", "with --time"});
  expect_render_refusal({"--strip", "mie.scattering"}, {"--strip", "LOW..HIGH"});
  expect_render_refusal({"--strip", "mie.fog=1..2"}, {"--strip", "mie.fog", "mie.scattering"});
  expect_render_refusal({"--strip", "ground.albedo=0..2"}, {"ground.albedo", "1.5"});
  expect_render_refusal({"--strip", "ground.albedo=0..1:1"}, {"--strip", "2 to 64 frames"});
  expect_render_refusal({"--strip", "ground.albedo=0..1:3:geometric"},
                        {"--strip", "ground.albedo=0..1:3:geometric", "above 0"});
  expect_render_refusal({"--strip", "fog=1,2"}, {"--strip", "fog=1,2", "altitude-m"});
  expect_render_refusal({"--rows", "altitude-m=5,high"}, {"--rows", "\"high\"", "finite number"});
  expect_render_refusal({"--rows", "altitude-m=0,5"},
                        {"--rows \"altitude-m=0\"", "height in metres"});
  expect_render_refusal({"--rows", "orders=1,99"}, {"--rows", "orders=1,99", "1 to 20"});
  expect_render_refusal({"--rows", "altitude-m=5,6", "--altitude-m", "7"},
                        {"--altitude-m \"7\"", "without --rows altitude-m=5,6"});
  expect_render_refusal({"--rows", "altitude-m=5,6", "--above-ground-m", "7"},
                        {"--rows \"altitude-m=5\"", "without --above-ground-m"});
  expect_render_refusal({"--rows", "altitude-m=5,6", "--strip", "altitude-m=5,6"},
                        {"--rows", "each name once"});
  expect_render_refusal({"--strip", "altitude-m=5,6", "--strip", "pitch-deg=1,2,3"},
                        {"--strip", "pitch-deg=1,2,3", "3 values", "expected 2"});
  expect_render_refusal({"--rows", "date=2026-06-21,2026-12-21", "--time", "12:00"},
                        {"--rows", "date=2026-06-21", "--latitude-deg"});
  expect_render_refusal({"--metering", "each"}, {"--metering", "--strip or --rows"});
  expect_render_refusal({"--strip", "altitude-m=5,6", "--metering", "one"},
                        {"--metering", "one", "together or each"});
  expect_render_refusal({"--strip", "altitude-m=5,6", "--size", "6000x6000"},
                        {"--size", "6000x6000", "2 x 1 frames have 12004 x 6000"});
  const std::vector<std::string> sequence = {"render",    "--preset", "earth-clear",
                                             "--out-dir", "x",        "--sequence"};
  expect_refusal(sequence + std::vector<std::string>{"missing.json"}, {"missing.json", "No such"});
  write("bad.json", "{\"skyfit_sequence\": 1,\n\"keyframes\": [{\"time_s\": \"noon\"}]}");
  expect_refusal(sequence + std::vector<std::string>{"bad.json"},
                 {"bad.json:2: keyframes[0].time_s", "noon", "a number"});
  write("planets.json", R"({"skyfit_sequence": 1, "keyframes": [{"time_s": 0},
      {"time_s": 1, "preset": "mars"}]})");
  expect_refusal(sequence + std::vector<std::string>{"planets.json"},
                 {"earth-clear and mars", "planet.bottom_radius_m"});
  write("fog.json", R"({"skyfit_sequence": 1, "keyframes": [{"time_s": 0}]})");
  const std::vector<std::string> fog = {"fog.json", "--model", "bodare", "--update-frames"};
  expect_refusal(sequence + fog + std::vector<std::string>{"3"},
                 {"--update-frames", "3", "2, 4, 8, 16 or 32"});
  expect_refusal(
      sequence + std::vector<std::string>{"fog.json", "--model", "oneil", "--update-frames", "2"},
      {"--update-frames", "the model bodare"});
  expect_render_refusal({"--model", "bodare", "--update-frames", "2"},
                        {"--update-frames", "--out-dir"});
  write("x/frames.json", "{}");
  write("good.json", kSequence);
  expect_refusal(sequence + std::vector<std::string>{"good.json"}, {"x/frames.json", "remove it"});
  expect_refusal(
      {"render", "--preset", "earth-clear", "--sequence", "good.json", "--out-dir", "a/b"},
      {"a/b", "No such file"});
  expect_refusal({"render", "--out", "x.png"}, {"--preset"});
  expect_refusal({"render", "--preset", "earth-clear"}, {"--out"});
}

}  // namespace
}  // namespace skyfit::cli
