#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/plot/png_file.h"
#include "app/scene/model_scene.h"
#include "core/text.h"

namespace sinew {
namespace {

struct PictureOptions {
  std::string model, view = "front", size = "800x1200";
  std::vector<std::string> bones;
  bool no_muscles = false, landmarks = false;
  std::filesystem::path output;
};

StandardView viewNamed(const std::string& name) {
  const std::vector<std::pair<std::string, StandardView>> views = {{"front", StandardView::Front},
                                                                   {"back", StandardView::Back},
                                                                   {"left", StandardView::Left},
                                                                   {"right", StandardView::Right},
                                                                   {"oblique", StandardView::Oblique}};
  for (const auto& [known, view] : views)
    if (known == name) return view;
  throw InputError{{"sinew model picture", "--view", "front, back, left, right or oblique", "'" + name + "'"}};
}

/// "800x1200". @throws InputError.
std::array<int, 2> sizeFrom(const std::string& text) {
  constexpr int kLargest = 8192;  // px: what every OpenGL 3.2 can draw
  int width = 0, height = 0, used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 || used != int(text.size()) || width < 16 ||
      height < 16 || width > kLargest || height > kLargest)
    throw InputError{{"sinew model picture", "--size", "WIDTHxHEIGHT, 16 to 8192 pixels each", "'" + text + "'"}};
  return {width, height};
}

/// The bones with these names; "femur" stands for both sides, all bones of a segment for the segment's name.
std::vector<BoneMesh> chosenBones(const Model& model, const std::vector<std::string>& names) {
  std::vector<BoneMesh> chosen;
  for (const auto& name : names) {
    const std::size_t before = chosen.size();
    for (const auto& bone : *model.bones)
      if (bone.bone == name || withoutSide(bone.bone) == name ||
          model.skeleton.segments[std::size_t(bone.segment)].name == name)
        chosen.push_back(bone);
    if (chosen.size() > before) continue;
    std::vector<std::string> known;
    for (const auto& bone : *model.bones) known.push_back(bone.bone);
    throw InputError{
        {"sinew model picture", "--bones", "a bone or segment", "'" + name + "'" + didYouMean(name, known)}};
  }
  return chosen;
}

ExitStatus makePicture(const PictureOptions& o, Session& session) {
  requirePngName(o.output, "sinew model picture");
  ModelPicture picture;
  picture.view = viewNamed(o.view);
  const auto [width, height] = sizeFrom(o.size);
  picture.width_px = width, picture.height_px = height;
  Model model = session.model(o.model);
  if (!o.bones.empty()) model.bones = std::make_shared<const std::vector<BoneMesh>>(chosenBones(model, o.bones));
  picture.muscles = !o.no_muscles && o.bones.empty();
  picture.mechanical_axes = false;
  picture.landmarks = o.landmarks;
  writePng(renderModel(model, zeroPosture(model.skeleton), picture), o.output);
  session.result({{"format", "sinew.model_picture"},
                  {"version", 1},
                  {"view", o.view},
                  {"width_px", width},
                  {"height_px", height},
                  {"bones", model.bones->size()},
                  {"muscles", picture.muscles}},
                 "written " + o.output.string() + "\n");
  return ExitStatus::Done;
}

}  // namespace

void addPictureCommand(CLI::App& parent, Commands& commands) {
  auto o = std::make_shared<PictureOptions>();
  auto& command = addCommand(parent, "picture", "a still picture of bones and muscles, standing; needs no display",
                             "sinew model picture reference --view back --bones pelvis,femur_r -o hip.png");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  command.add_option("-o,--output", o->output, "file: .png")->required();
  command.add_option("--view", o->view, "front, back, left, right or oblique")->capture_default_str();
  command.add_option("--bones", o->bones, "only these bones or segments, without muscles")->delimiter(',');
  command.add_option("--size", o->size, "pixels, WIDTHxHEIGHT")->capture_default_str();
  command.add_flag("--no-muscles", o->no_muscles, "bones alone");
  command.add_flag("--landmarks", o->landmarks, "landmarks as dots");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return makePicture(*o, session); }; });
}

}  // namespace sinew
