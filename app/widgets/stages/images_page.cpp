#include "app/widgets/stages/images_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/radiograph_pane.h"
#include "clinical/case/case_views.h"
#include "clinical/case/new_case.h"
#include "core/text.h"

namespace sinew {

ImagesPage::ImagesPage(Workspace& workspace)
    : StagePage{workspace, Stage::Images, tr("Wheel zooms, drag moves, right drag sets the grey window.")} {
  const QString files = tr("Radiographs (*.dcm *.tif *.tiff *.png);;All files (*)");
  auto* add =
      makeButton("add_view", tr("Add view …"), "import", tr("A third exposure, or another part of a stitched pair"));
  remove_ = makeButton("remove_view", tr("Remove view"), "delete", tr("Take the view on the right out of the case"));
  actions().addWidget(add);
  actions().addWidget(remove_);
  connect(add, &QPushButton::clicked, this, [this, files] {
    const auto file = askForFile(this, tr("Radiograph"), files);
    if (!file.empty()) addImage(file);
  });
  connect(remove_, &QPushButton::clicked, this, &ImagesPage::removeShownView);
  auto* row = new QHBoxLayout;
  row->setSpacing(12);
  for (int view = 0; view < 2; ++view) {
    sides_[std::size_t(view)] = makeSide(view);
    RadiographPane* pane = sides_[std::size_t(view)].pane;
    connect(pane, &RadiographPane::viewChanged, this, [this] { refresh(); });
    auto* column = new QVBoxLayout;
    column->setSpacing(8);
    column->addWidget(pane, 1);
    auto* card = new Card;
    auto* line = new QHBoxLayout;
    auto* text = new QVBoxLayout;
    text->setSpacing(2);
    text->addWidget(sides_[std::size_t(view)].kind);
    text->addWidget(sides_[std::size_t(view)].size);
    line->addLayout(text, 1);
    auto* replace = makeButton(view == 0 ? "replace_frontal" : "replace_lateral", tr("Replace …"), "import",
                               tr("Take another file for this view"));
    connect(replace, &QPushButton::clicked, this, [this, pane, files] {
      const auto file = askForFile(this, tr("Radiograph"), files);
      if (!file.empty()) replaceImage(pane->viewIndex(), file);
    });
    line->addWidget(replace);
    card->content().addLayout(line);
    card->content().addWidget(sides_[std::size_t(view)].declared_row);
    column->addWidget(card);
    row->addLayout(column, 1);
  }
  body().addLayout(row, 1);
}

ImagesPage::Side ImagesPage::makeSide(int place) {
  Side side;
  side.pane = new RadiographPane{workspace(), place, true};
  side.kind = makeLabel({}, "heading");
  side.kind->setObjectName(place == 0 ? "frontal_kind" : "lateral_kind");
  side.size = makeLabel({}, "small");
  side.size->setObjectName(place == 0 ? "frontal_info" : "lateral_info");
  side.size->setWordWrap(true);
  side.size->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  side.declared_row = new QWidget;
  auto* row = new QHBoxLayout{side.declared_row};
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(makeLabel(tr("Size of a pixel"), "small"));
  side.declared_mm = new QLineEdit;
  side.declared_mm->setObjectName(place == 0 ? "frontal_declared_mm" : "lateral_declared_mm");
  side.declared_mm->setPlaceholderText(tr("unknown"));
  side.declared_mm->setAccessibleName(tr("Declared pixel size in millimetres"));
  side.declared_mm->setFixedWidth(90);
  row->addWidget(side.declared_mm);
  row->addWidget(makeLabel(tr("mm, if you know it: it is marked as declared"), "small"), 1);
  connect(side.declared_mm, &QLineEdit::editingFinished, this, [this, pane = side.pane, edit = side.declared_mm] {
    declareSpacing(pane->viewIndex(), edit->text().trimmed());
  });
  return side;
}

void ImagesPage::refresh() {
  for (Side& side : sides_) refreshSide(side);
  remove_->setVisible(shownCase().images.size() > 2);
}

void ImagesPage::refreshSide(Side& side) {
  side.pane->refresh();
  const Case& c = shownCase();
  const std::size_t view = std::size_t(side.pane->viewIndex());
  const Radiograph* r = side.pane->view().radiograph();
  const bool declared = view < c.images.size() && c.images[view].declared_spacing_mm;
  side.declared_row->setVisible(r && (!r->spacing || declared));
  side.declared_mm->setText(declared ? QString::number(*c.images[view].declared_spacing_mm) : QString{});
  if (!r) {
    side.kind->setText(tr("No image"));
    side.size->setText(tr("Choose a DICOM, TIFF or PNG file."));
    return;
  }
  QStringList kind;
  kind << (r->tags.modality.empty() ? tr("Image file") : QString::fromStdString(r->tags.modality));
  if (!r->tags.view_position.empty()) kind << QString::fromStdString(r->tags.view_position);
  if (!r->tags.manufacturer.empty()) kind << QString::fromStdString(r->tags.manufacturer);
  side.kind->setText(kind.join(" · "));
  QStringList size;
  size << tr("%1 × %2 px, %3 bit").arg(r->width_px).arg(r->height_px).arg(r->bits_stored) << spacingText(*r);
  if (!r->tags.transfer_syntax.empty()) size << QString::fromStdString(r->tags.transfer_syntax);
  side.size->setText(size.join("  ·  "));
}

void ImagesPage::replaceImage(int view, const std::filesystem::path& file) {
  workspace().document().edit(tr("Replace %1 radiograph").arg(viewTitle(shownCase(), view).toLower()), [&](Case& c) {
    c.images.resize(std::max<std::size_t>(c.images.size(), std::size_t(view) + 1));
    c.images[std::size_t(view)] = importRadiograph(file, workspace().document().folder(), view, {});
  });
}

void ImagesPage::addImage(const std::filesystem::path& file) {
  const int view = int(shownCase().images.size());
  const bool added = workspace().document().edit(tr("Add view %1").arg(view + 1), [&](Case& c) {
    c.images.push_back(importRadiograph(file, workspace().document().folder(), view, {}));
  });
  if (added) sides_[1].pane->setViewIndex(view);
}

void ImagesPage::removeShownView() {
  const int view = sides_[1].pane->viewIndex();
  workspace().document().edit(tr("Remove %1 view").arg(viewTitle(shownCase(), view).toLower()),
                              [view](Case& c) { removeView(c, view); });
}

void ImagesPage::declareSpacing(int view, const QString& text) {
  workspace().document().edit(tr("Declare pixel size"), [&](Case& c) {
    if (std::size_t(view) >= c.images.size()) return;
    auto& declared = c.images[std::size_t(view)].declared_spacing_mm;
    if (text.isEmpty()) {
      declared.reset();
      return;
    }
    const double value_mm = parseNumber(text.toStdString(), "images", "pixel size");
    if (!(value_mm >= 0.01 && value_mm <= 5))
      throw InputError{{"images", "pixel size", "0.01 to 5 mm", text.toStdString()}};
    declared = value_mm;
  });
  refresh();
}

}  // namespace sinew
