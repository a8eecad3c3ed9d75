#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cstdlib>
#include <ostream>
#include <stdexcept>

#include "app/scene/offscreen.h"

namespace sinew {

void PrintTo(const OffscreenOptions& o, std::ostream* out);  // names the tests
void PrintTo(const OffscreenOptions& o, std::ostream* out) {
  *out << o.supersampling << (o.ambient_occlusion ? "x with occlusion" : "x");
}

namespace {

void whiteBallOnBlue(vtkRenderer& renderer) {
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.5);
  ball->SetThetaResolution(64);
  ball->SetPhiResolution(64);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
  renderer.SetBackground(0, 0, 1);
  renderer.GetActiveCamera();
  renderer.ResetCamera();
}

class Offscreen : public testing::TestWithParam<OffscreenOptions> {};

TEST_P(Offscreen, NeedsNoDisplayAndPutsTheFirstRowOnTop) {
  unsetenv("DISPLAY");
  const auto image = renderOffscreen(80, 60, whiteBallOnBlue, GetParam());
  ASSERT_EQ(image.width_px, 80);
  ASSERT_EQ(image.height_px, 60);
  ASSERT_EQ(image.rgb.size(), 80u * 60u * 3u);
  EXPECT_GT(image.at(40, 30)[0], 200);
  for (const auto* corner : {image.at(0, 0), image.at(79, 59)}) {
    EXPECT_LT(corner[0], 30);
    EXPECT_GT(corner[2], 225);
  }
}
INSTANTIATE_TEST_SUITE_P(Qualities, Offscreen,
                         testing::Values(OffscreenOptions{1, false}, OffscreenOptions{2, false},
                                         OffscreenOptions{2, true}));

TEST(OffscreenErrors, WhatComposeThrowsArrivesAndTheNextPictureIsFine) {
  EXPECT_THROW(renderOffscreen(10, 10, [](vtkRenderer&) { throw std::runtime_error{"no such bone"}; }),
               std::runtime_error);
  EXPECT_GT(renderOffscreen(20, 20, whiteBallOnBlue, {1, false}).at(10, 10)[0], 200);
  EXPECT_THROW(renderOffscreen(0, 10, whiteBallOnBlue), std::logic_error);
}

}  // namespace
}  // namespace sinew
