#include "app/scene/rom_patch.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>
#include <numbers>

namespace sinew {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPolarStep_rad = kPi / RomMap::kPolars, kAzimuthStep_rad = 2 * kPi / RomMap::kAzimuths;
constexpr int kFine = 3;  // a cell is drawn as so many times so many pieces, to be round

/// The axes of the frame: e1 azimuth 0, e2 azimuth 90 degrees, e3 the pole.
Eigen::Matrix3d axesOf(const RomMapFrame& frame) {
  Eigen::Matrix3d axes;
  axes.col(2) = frame.shaft_J;
  axes.col(0) = frame.forward_J;
  axes.col(1) = frame.shaft_J.cross(frame.forward_J);
  return axes;
}

Eigen::Vector3d onSphere(const Eigen::Matrix3d& axes, double polar_rad, double azimuth_rad) {
  return axes * Eigen::Vector3d{std::sin(polar_rad) * std::cos(azimuth_rad),
                                std::sin(polar_rad) * std::sin(azimuth_rad), std::cos(polar_rad)};
}

/// Points of a sphere with their normals, as a surface or as lines.
struct Drawing {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkCellArray> cells;
  Drawing() { normals->SetNumberOfComponents(3); }
  vtkIdType add(const Eigen::Vector3d& n, double radius_m) {
    const Eigen::Vector3d p = radius_m * n;
    normals->InsertNextTuple(n.data());
    return points->InsertNextPoint(p.data());
  }
  vtkSmartPointer<vtkPolyData> lines() const {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetLines(cells);
    return data;
  }
};

/// A line of constant polar angle or azimuth.
void addArc(Drawing& drawing, const Eigen::Matrix3d& axes, std::array<double, 2> polar_rad,
            std::array<double, 2> azimuth_rad, int pieces, double radius_m) {
  drawing.cells->InsertNextCell(pieces + 1);
  for (int i = 0; i <= pieces; ++i) {
    const double t = double(i) / pieces;
    drawing.cells->InsertCellPoint(drawing.add(
        onSphere(axes, std::lerp(polar_rad[0], polar_rad[1], t), std::lerp(azimuth_rad[0], azimuth_rad[1], t)),
        radius_m));
  }
}

}  // namespace

Rgb romColour(double width_rad, double widest_rad) {
  static constexpr std::array kStops = {Rgb{1.00, 0.96, 0.62}, Rgb{0.99, 0.80, 0.36}, Rgb{0.97, 0.55, 0.22},
                                        Rgb{0.86, 0.24, 0.13}, Rgb{0.55, 0.02, 0.12}};
  return interpolatedColour(kStops, widest_rad > 0 ? width_rad / widest_rad : 0);
}

vtkSmartPointer<vtkPolyData> romPatch(const RomMap& map, double radius_m, double widest_rad) {
  const Eigen::Matrix3d axes = axesOf(map.frame);
  Drawing drawing;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("colour");
  colours->SetNumberOfComponents(3);
  for (int polar = 0; polar < RomMap::kPolars; ++polar)
    for (int azimuth = 0; azimuth < RomMap::kAzimuths; ++azimuth) {
      const double width_rad = map.twistWidth_rad(polar, azimuth);
      if (!(width_rad > 0)) continue;
      const Rgb c = romColour(width_rad, widest_rad);
      std::array<std::array<vtkIdType, kFine + 1>, kFine + 1> corner{};
      for (int i = 0; i <= kFine; ++i)
        for (int k = 0; k <= kFine; ++k)
          corner[std::size_t(i)][std::size_t(k)] =
              drawing.add(onSphere(axes, (polar + double(i) / kFine) * kPolarStep_rad,
                                   (azimuth + double(k) / kFine) * kAzimuthStep_rad),
                          radius_m);
      for (std::size_t i = 0; i < kFine; ++i)
        for (std::size_t k = 0; k < kFine; ++k) {
          drawing.cells->InsertNextCell({corner[i][k], corner[i + 1][k], corner[i + 1][k + 1], corner[i][k + 1]});
          colours->InsertNextTuple3(255 * c.r, 255 * c.g, 255 * c.b);
        }
    }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(drawing.points);
  data->SetPolys(drawing.cells);
  data->GetPointData()->SetNormals(drawing.normals);
  data->GetCellData()->AddArray(colours);
  return data;
}

vtkSmartPointer<vtkPolyData> romBorder(const RomMap& map, double radius_m) {
  const Eigen::Matrix3d axes = axesOf(map.frame);
  const auto isFree = [&](int polar, int azimuth) {
    if (polar < 0 || polar >= RomMap::kPolars) return true;  // the pole itself is no border
    return map.twistWidth_rad(polar, (azimuth + RomMap::kAzimuths) % RomMap::kAzimuths) > 0;
  };
  Drawing drawing;
  for (int polar = 0; polar < RomMap::kPolars; ++polar)
    for (int azimuth = 0; azimuth < RomMap::kAzimuths; ++azimuth) {
      if (!isFree(polar, azimuth)) continue;
      const double p = polar * kPolarStep_rad, a = azimuth * kAzimuthStep_rad;
      const double p1 = p + kPolarStep_rad, a1 = a + kAzimuthStep_rad;
      if (!isFree(polar - 1, azimuth)) addArc(drawing, axes, {p, p}, {a, a1}, kFine, radius_m);
      if (!isFree(polar + 1, azimuth)) addArc(drawing, axes, {p1, p1}, {a, a1}, kFine, radius_m);
      if (!isFree(polar, azimuth - 1)) addArc(drawing, axes, {p, p1}, {a, a}, kFine, radius_m);
      if (!isFree(polar, azimuth + 1)) addArc(drawing, axes, {p, p1}, {a1, a1}, kFine, radius_m);
    }
  return drawing.lines();
}

vtkSmartPointer<vtkPolyData> romGraticule(const RomMapFrame& frame, double radius_m) {
  constexpr int kStep_deg = 30, kPieces = 72;
  const Eigen::Matrix3d axes = axesOf(frame);
  Drawing drawing;
  for (int deg = kStep_deg; deg < 180; deg += kStep_deg) {
    const double polar_rad = deg * kPi / 180;
    addArc(drawing, axes, {polar_rad, polar_rad}, {0, 2 * kPi}, kPieces, radius_m);
  }
  for (int deg = 0; deg < 360; deg += kStep_deg) {
    const double azimuth_rad = deg * kPi / 180;
    addArc(drawing, axes, {0, kPi}, {azimuth_rad, azimuth_rad}, kPieces, radius_m);
  }
  return drawing.lines();
}

}  // namespace sinew
