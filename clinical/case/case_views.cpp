#include "clinical/case/case_views.h"

namespace sinew {
namespace {

/// Only where there is one for every image: otherwise what belongs to which view is not known.
template <class T>
void eraseView(std::vector<T>& of_views, std::size_t count, int view) {
  if (of_views.size() == count) of_views.erase(of_views.begin() + view);
}

}  // namespace

void removeView(Case& c, int view) {
  const std::size_t count = c.images.size();
  if (view < 0 || view >= int(count))
    throw InputError{{"images", "view", "one of " + std::to_string(count), std::to_string(view + 1)}};
  if (count <= 2) throw InputError{{"images", "views", "two or more that remain", std::to_string(count - 1)}};
  c.images.erase(c.images.begin() + view);
  if (c.phantom) eraseView(c.phantom->images, count, view);
  if (c.imported_rig) {
    eraseView(c.imported_rig->views, count, view);
    c.imported_rig->calibration.id = geometryId(c.imported_rig->views);
  }
  std::erase_if(c.sightings, [&](const Sighting& s) { return s.view == view; });
  for (auto& s : c.sightings)
    if (s.view > view) --s.view;
}

}  // namespace sinew
