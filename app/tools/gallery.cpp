// sinew-gallery RESOURCE_DIR OUT_DIR: every picture of docs/gallery.md, drawn anew without a display. Prints the
// counts of the range maps.
#include <QImage>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "app/scene/lineup.h"
#include "app/scene/model_scene.h"
#include "app/scene/rom_sphere.h"
#include "core/model/physical_scaling.h"
#include "core/posture/evaluate.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/rom/maps/rom_map.h"
#include "core/skeleton/clinical_angles.h"
#include "core/text.h"

namespace sinew {
namespace {

struct Shot {
  const char* name;
  StandardView view;
  const char* segment = nullptr;  ///< close-up about its origin; nullptr: the whole body
  Eigen::Vector3d offset_W = Eigen::Vector3d::Zero();
  double half_height_m = 0;
  bool arms_out = false;  ///< they hang in front of the hip
};

const Shot kShots[] = {
    {"front", StandardView::Front},
    {"back", StandardView::Back},
    {"right", StandardView::Right},
    {"left", StandardView::Left},
    {"oblique", StandardView::Oblique},
    {"shoulder-front", StandardView::Front, "humerus_r", {0, -0.04, -0.05}, 0.17},
    {"shoulder-back", StandardView::Back, "humerus_r", {0, -0.04, -0.05}, 0.17},
    {"hip-front", StandardView::Front, "femur_r", {0, 0.0, -0.03}, 0.19, true},
    {"hip-right", StandardView::Right, "femur_r", {0, 0.0, 0}, 0.19, true},
    {"hip-back", StandardView::Back, "femur_r", {0, 0.0, -0.03}, 0.19, true},
    {"knee-front", StandardView::Front, "tibia_r", {0, 0, 0}, 0.13},
    {"knee-right", StandardView::Right, "tibia_r", {0, 0, 0}, 0.13},
    {"knee-back", StandardView::Back, "tibia_r", {0, 0, 0}, 0.13},
    {"foot-right", StandardView::Right, "foot_r", {0.06, -0.01, 0}, 0.11},
    {"foot-front", StandardView::Front, "foot_r", {0.06, -0.01, 0}, 0.11},
    {"foot-oblique", StandardView::Oblique, "foot_r", {0.06, -0.01, 0}, 0.12},
    {"spine-back", StandardView::Back, "lumbar", {0, 0.15, 0}, 0.36, true},
    {"spine-right", StandardView::Right, "lumbar", {0, 0.15, 0}, 0.36, true},
};

void save(const RgbImage& picture, const std::filesystem::path& file) {
  auto rgb = picture.rgb;
  for (auto& c : rgb) c = std::uint8_t((c & 0xF8) | (c >> 5));  // 32 levels are enough and make half the file
  const QImage image{rgb.data(), picture.width_px, picture.height_px, 3 * picture.width_px, QImage::Format_RGB888};
  if (!image.save(QString::fromStdString(file.string())))
    throw InputError{{file.string(), "picture", "a file that can be written", "none"}};
}

void drawBody(const Model& model, const std::filesystem::path& out) {
  const Posture standing = zeroPosture(model.skeleton),
                arms_out = postureFromDegrees(model.skeleton, {{"shoulder_adduction_r", -67},
                                                               {"girdle_elevation_r", 23},
                                                               {"shoulder_adduction_l", -67},
                                                               {"girdle_elevation_l", 23}});
  const auto X_WB = segmentPoses(model.skeleton, standing);
  for (const Shot& shot : kShots)
    for (const bool muscles : {false, true}) {
      ModelPicture picture;
      picture.view = shot.view;
      picture.muscles = muscles;
      picture.mechanical_axes = false;
      picture.width_px = 300;
      picture.height_px = 640;
      if (shot.segment) {
        picture.width_px = picture.height_px = 340;
        const auto segment = std::size_t(model.skeleton.segmentIndex(shot.segment));
        picture.focus = {X_WB[segment].translation() + shot.offset_W, shot.half_height_m};
      }
      save(renderModel(model, shot.arms_out ? arms_out : standing, picture),
           out / (std::string{shot.name} + (muscles ? "-muscles.png" : "-bones.png")));
    }
}

/// The map of a joint with a second coordinate at two angles, as spheres with one colour scale, and on the body.
void drawRom(const Model& model, const std::string& joint, const std::string& with, std::array<double, 2> with_deg,
             const std::filesystem::path& out) {
  std::vector<RomMap> maps;
  std::vector<Posture> postures;
  double widest_rad = 0;
  for (const double deg : with_deg) {
    postures.push_back(postureFromDegrees(model.skeleton, {{with, deg}}));
    maps.push_back(romMap(model, joint, postures.back()));
    for (int polar = 0; polar < RomMap::kPolars; ++polar)
      for (int azimuth = 0; azimuth < RomMap::kAzimuths; ++azimuth)
        widest_rad = std::max(widest_rad, maps.back().twistWidth_rad(polar, azimuth));
  }
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const std::string label = joint + "-" + fixed(with_deg[i], 0);
    RomPicture sphere;
    sphere.width_px = sphere.height_px = 400;
    sphere.widest_rad = widest_rad;
    save(renderRomSphere(maps[i], sphere), out / ("rom-" + label + ".png"));
    ModelPicture body;
    body.width_px = 300;
    body.height_px = 400;
    body.view = StandardView::Oblique;
    body.mechanical_axes = false;
    body.muscles = false;
    body.rom = maps[i];
    body.rom_widest_rad = widest_rad;
    const auto X_WB = segmentPoses(model.skeleton, postures[i]);
    const int child = model.skeleton.joints[std::size_t(model.skeleton.jointIndex(joint))].child;
    body.focus = {X_WB[std::size_t(child)].translation() + Eigen::Vector3d{0, -0.08, 0}, 0.46};
    save(renderModel(model, postures[i], body), out / ("rom-body-" + std::string{label} + ".png"));
    std::printf("%s, %s %.0f deg: %d of %d cells\n", joint.c_str(), with.c_str(), with_deg[i], maps[i].validCount(),
                RomMap::kCells);
  }
  const RomDifference d = compare(maps[0], maps[1]);
  std::printf("%s: %d cells differ, %.1f %% of all, %.1f %% of those valid in either; widest twist range %.0f deg\n",
              joint.c_str(), d.differing(), 100 * d.ofAll(), 100 * d.ofUnion(), widest_rad * 180 / std::numbers::pi);
}

/// What the colours of the window show, in a posture that stretches.
void drawColours(const Model& model, const std::filesystem::path& out) {
  const Posture raised = postureFromDegrees(model.skeleton, {{"hip_flexion_r", 70}});
  ModelPicture picture;
  picture.width_px = 300;
  picture.height_px = 640;
  picture.view = StandardView::Right;
  picture.mechanical_axes = false;
  save(renderModel(model, raised, picture), out / "raised-groups.png");
  MuscleScalars fiber{{}, 0.4, 1.6, true}, force{{}, 0, 20, false};
  const PostureEvaluation e = evaluatePosture(model.skeleton, model.musculature, raised);
  for (std::size_t i = 0; i < model.musculature.units.size(); ++i) {
    const auto& unit = model.musculature.units[i];
    fiber.by_unit[unit.name] = e.normalized_fiber_length[Eigen::Index(i)];
    force.by_unit[unit.name] = 100 * e.passive_force_N[Eigen::Index(i)] / unit.max_isometric_force_N;
  }
  picture.scalars = fiber;
  save(renderModel(model, raised, picture), out / "raised-fibre-length.png");
  picture.scalars = force;
  save(renderModel(model, raised, picture), out / "raised-passive-force.png");
}

/// The reference, hulk, dwarf and alien side by side, their muscles retargeted.
void drawCharacters(const std::filesystem::path& resource_dir, const std::filesystem::path& out) {
  const auto reference = loadRetargetReference(resource_dir);
  std::vector<LineupBody> bodies;
  for (const char* name : {"human", "hulk", "dwarf", "alien"}) {
    const BodyDescription body = loadShapePreset(resource_dir, name);
    const Retargeted made = retarget(*reference, body.shape);
    const auto model = std::make_shared<const Model>(withPhysics(made.model, reference->model(), body.physics));
    bodies.push_back({model, standingOnGround(*model)});
    std::printf("%s: retargeted in %.2f s\n", name, made.times.total_s());
  }
  LineupPicture picture;
  picture.height_px = 560;
  save(renderLineup(bodies, picture).image, out / "characters-front.png");
  picture.view = StandardView::Oblique;
  save(renderLineup(bodies, picture).image, out / "characters-oblique.png");
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: sinew-gallery RESOURCE_DIR OUT_DIR\n");
    return 2;
  }
  try {
    const std::filesystem::path out = argv[2];
    std::filesystem::create_directories(out);
    const sinew::Model model = sinew::loadReferenceModel(argv[1]);
    sinew::drawBody(model, out);
    sinew::drawColours(model, out);
    sinew::drawRom(model, "hip_r", "knee_flexion_r", {0, 90}, out);
    sinew::drawRom(model, "shoulder_r", "elbow_flexion_r", {0, 120}, out);
    sinew::drawCharacters(argv[1], out);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sinew-gallery: %s\n", error.what());
    return 2;
  }
}
