#include "core/io/motion/bvh.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr std::array<std::string_view, 6> kChannelNames{"Xposition", "Yposition", "Zposition",
                                                        "Xrotation", "Yrotation", "Zrotation"};
constexpr int kDeepest = 100, kMostJoints = 1000, kMostFrames = 10'000'000;

/// Words of the text, with the line that each stands in.
class Words {
 public:
  Words(std::string_view text, const std::string& where) : text_{text}, where_{where} { advance(); }

  std::string_view peek() const { return word_; }
  std::string_view take() {
    const std::string_view word = word_;
    advance();
    return word;
  }
  void expect(std::string_view wanted) {
    if (word_ != wanted) fail("'" + std::string{wanted} + "'");
    advance();
  }
  double number(const std::string& what) {
    double value = 0;
    const auto [end, error] = std::from_chars(word_.data(), word_.data() + word_.size(), value);
    if (error == std::errc::result_out_of_range && end == word_.data() + word_.size())
      value = 0;  // smaller than any double, as exporters write for nothing
    else if (error != std::errc{} || end != word_.data() + word_.size() || !std::isfinite(value))
      fail(what);
    advance();
    return value;
  }
  int count(const std::string& what, int most) {
    const int line = line_;
    const std::string found{word_};
    const double value = number(what);
    if (value < 0 || value > most || value != std::floor(value)) failAt(line, what, found);
    return static_cast<int>(value);
  }
  [[noreturn]] void fail(const std::string& expected) const {
    failAt(line_, expected, word_.empty() ? "the end of the file" : std::string{word_.substr(0, 60)});
  }

 private:
  [[noreturn]] void failAt(int line, const std::string& expected, const std::string& found) const {
    throw InputError{{where_ + ": line " + std::to_string(line), "", expected,
                      found == "the end of the file" ? found : "'" + found + "'"}};
  }
  void advance() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) {
      if (text_[at_] == '\n') ++line_;
      ++at_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    word_ = text_.substr(begin, at_ - begin);
  }

  std::string_view text_, word_;
  std::string where_;
  std::size_t at_ = 0;
  int line_ = 1;
};

BvhChannel channelFrom(Words& words) {
  const auto found = std::ranges::find(kChannelNames, words.peek());
  if (found == kChannelNames.end()) words.fail("a channel (Xposition .. Zrotation)");
  words.take();
  return static_cast<BvhChannel>(found - kChannelNames.begin());
}

Eigen::Vector3d offsetFrom(Words& words) {
  words.expect("OFFSET");
  const double x = words.number("a number"), y = words.number("a number"), z = words.number("a number");
  return {x, y, z};
}

/// One joint after its keyword, with all that hangs on it.
void readJoint(Words& words, int parent, int depth, int& channel_count, std::vector<BvhJoint>& joints) {
  if (depth > kDeepest) words.fail("at most " + std::to_string(kDeepest) + " joints in a chain");
  if (joints.size() >= kMostJoints) words.fail("at most " + std::to_string(kMostJoints) + " joints");
  if (words.peek().empty() || words.peek() == "{") words.fail("the name of a joint");
  const int index = static_cast<int>(joints.size());
  joints.push_back({.name = std::string{words.take()}, .parent = parent});
  words.expect("{");
  joints[index].offset = offsetFrom(words);
  words.expect("CHANNELS");
  const int channels = words.count("a number of channels up to 6", 6);
  joints[index].first_channel = channel_count;
  for (int i = 0; i < channels; ++i) joints[index].channels.push_back(channelFrom(words));
  channel_count += channels;
  while (words.peek() != "}") {
    if (words.peek() == "JOINT") {
      words.take();
      readJoint(words, index, depth + 1, channel_count, joints);
    } else if (words.peek() == "End") {
      words.take();
      words.expect("Site");
      words.expect("{");
      joints.push_back({.name = joints[index].name + "_end", .parent = index, .offset = offsetFrom(words)});
      joints.back().first_channel = channel_count;
      words.expect("}");
    } else {
      words.fail("JOINT, End Site or }");
    }
  }
  words.take();
}

}  // namespace

BvhMotion parseBvh(std::string_view text, const std::string& where) {
  Words words{text, where};
  BvhMotion motion;
  int channel_count = 0;
  words.expect("HIERARCHY");
  if (words.peek() != "ROOT") words.fail("ROOT");
  while (words.peek() == "ROOT") {
    words.take();
    readJoint(words, -1, 0, channel_count, motion.joints);
  }
  words.expect("MOTION");
  words.expect("Frames:");
  const int frames = words.count("a number of frames", kMostFrames);
  words.expect("Frame");
  words.expect("Time:");
  motion.frame_time_s = words.number("seconds between frames");
  // Every value takes two characters at least: a wrong count must not ask for memory that the file cannot fill.
  if (static_cast<double>(frames) * channel_count > static_cast<double>(text.size()))
    words.fail(std::to_string(frames) + " frames of " + std::to_string(channel_count) + " values, so a longer file");
  motion.channels.resize(channel_count, frames);
  for (int f = 0; f < frames; ++f)
    for (int c = 0; c < channel_count; ++c)
      motion.channels(c, f) = words.number("value " + std::to_string(c + 1) + " of " + std::to_string(channel_count) +
                                           " of frame " + std::to_string(f + 1));
  if (!words.peek().empty()) words.fail("the end of the file after " + std::to_string(frames) + " frames");
  return motion;
}

BvhMotion loadBvh(const std::filesystem::path& file) {
  return parseBvh(readFile(file, std::uintmax_t{1} << 30), file.filename().string());
}

std::string bvhText(const BvhMotion& motion) {
  const auto number = [](double value) { return brief(value, 9); };
  std::string text = "HIERARCHY\n";
  std::vector<int> rows;  // of the channels, in the order in which the joints are written
  const auto write = [&](const auto& self, int index, const std::string& indent) -> void {
    const BvhJoint& joint = motion.joints[index];
    const bool end_site = joint.channels.empty() && joint.name.ends_with("_end");
    text += indent + (end_site ? "End Site" : (joint.parent < 0 ? "ROOT " : "JOINT ") + joint.name) + "\n" + indent +
            "{\n" + indent + "  OFFSET";
    for (const double x : joint.offset) text += " " + number(x);
    text += "\n";
    if (!end_site) {
      text += indent + "  CHANNELS " + std::to_string(joint.channels.size());
      for (const BvhChannel c : joint.channels) text += " " + std::string{kChannelNames[static_cast<std::size_t>(c)]};
      for (std::size_t c = 0; c < joint.channels.size(); ++c)
        rows.push_back(joint.first_channel + static_cast<int>(c));
      text += "\n";
    }
    for (std::size_t child = 0; child < motion.joints.size(); ++child)
      if (motion.joints[child].parent == index) self(self, static_cast<int>(child), indent + "  ");
    text += indent + "}\n";
  };
  for (std::size_t i = 0; i < motion.joints.size(); ++i)
    if (motion.joints[i].parent < 0) write(write, static_cast<int>(i), "");
  text += "MOTION\nFrames: " + std::to_string(motion.channels.cols()) +
          "\nFrame Time: " + number(motion.frame_time_s) + "\n";
  for (Eigen::Index f = 0; f < motion.channels.cols(); ++f) {
    for (const int row : rows) text += (&row == rows.data() ? "" : " ") + number(motion.channels(row, f));
    text += "\n";
  }
  return text;
}

std::vector<RigidTransform> bvhPoses(const BvhMotion& motion, int frame) {
  require(frame < motion.channels.cols(), "bvhPoses: the frame exists");
  std::vector<RigidTransform> X_WJ;
  for (const BvhJoint& joint : motion.joints) {
    RigidTransform X = RigidTransform::Identity();
    X.translation() = joint.offset;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    bool placed = false;
    for (std::size_t i = 0; frame >= 0 && i < joint.channels.size(); ++i) {
      const double value = motion.channels(joint.first_channel + static_cast<int>(i), frame);
      const int axis = static_cast<int>(joint.channels[i]) % 3;
      if (joint.channels[i] <= BvhChannel::Zposition) {
        position[axis] = value;
        placed = true;
      } else {
        X.linear() = X.linear() * rotationAbout<double>(Eigen::Vector3d::Unit(axis), value * std::numbers::pi / 180);
      }
    }
    if (placed) X.translation() = position;  // a position channel gives the place itself, not what is added to OFFSET
    X_WJ.push_back(joint.parent < 0 ? X : X_WJ[joint.parent] * X);
  }
  return X_WJ;
}

}  // namespace sinew
