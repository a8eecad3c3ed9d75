#include "app/widgets/shell/header_bar.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"

namespace sinew {
namespace {

/// DICOM's "Family^Given" for a reader.
QString readablePerson(const std::string& name) {
  const QStringList parts = QString::fromStdString(name).section('=', 0, 0).split('^', Qt::SkipEmptyParts);
  return parts.join(", ");
}

}  // namespace

HeaderBar::HeaderBar(Workspace& workspace, const Actions& actions, QWidget* parent)
    : QWidget{parent}, workspace_{workspace}, actions_{actions} {
  setObjectName("header_bar");
  setAttribute(Qt::WA_StyledBackground);
  setFixedHeight(56);
  auto* row = new QHBoxLayout{this};
  row->setContentsMargins(18, 0, 16, 0);
  row->setSpacing(6);
  auto* mark = new QLabel;
  mark->setPixmap(icon("sinew", colour::kPrimary).pixmap(26, 26));
  auto* name = makeLabel("Sinew", "title");
  name->setStyleSheet("color: " + colour::kPrimaryDark.name());
  row->addWidget(mark);
  row->addWidget(name);
  row->addSpacing(70);
  auto* edit_patient = new QToolButton;
  edit_patient->setObjectName("patient_button");
  edit_patient->setDefaultAction(actions.patient);
  edit_patient->setIconSize({20, 20});
  edit_patient->setMinimumSize(36, 34);
  edit_patient->setAccessibleName(actions.patient->text());
  edit_patient->setToolButtonStyle(Qt::ToolButtonIconOnly);
  row->addWidget(edit_patient);

  patient_ = new ElidedLabel{"heading"};
  patient_->setObjectName("patient_name");
  details_ = new ElidedLabel{"small"};
  details_->setObjectName("patient_details");
  auto* text = new QVBoxLayout;
  text->setSpacing(0);
  text->addStretch();
  text->addWidget(patient_);
  text->addWidget(details_);
  text->addStretch();
  row->addLayout(text, 1);

  saved_ = makeLabel({}, "small");
  saved_->setObjectName("saved_state");
  row->addWidget(saved_);
  row->addSpacing(10);
  const std::pair<QAction*, const char*> buttons[] = {{actions.undo, "undo_button"},
                                                      {actions.redo, "redo_button"},
                                                      {actions.new_case, "new_button"},
                                                      {actions.open, "open_button"},
                                                      {actions.save, "save_button"}};
  for (const auto& [action, object_name] : buttons) {
    auto* button = new QToolButton;
    button->setObjectName(object_name);
    button->setDefaultAction(action);
    button->setIconSize({20, 20});
    button->setText(action->text());
    button->setMinimumSize(action == actions.undo || action == actions.redo ? 36 : 84, 34);
    button->setAccessibleName(action->text());
    const bool words = action != actions.undo && action != actions.redo;
    button->setToolButtonStyle(words ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
    button->setProperty("words", words);
    row->addWidget(button);
    if (action == actions.redo) row->addSpacing(10);
  }
  connect(&workspace_.document(), &CaseDocument::changed, this, &HeaderBar::refresh);
  connect(&workspace_.document(), &CaseDocument::saved, this, &HeaderBar::refresh);
  refresh();
}

void HeaderBar::refresh() {
  const CaseDocument& document = workspace_.document();
  const Patient& patient = document.current().patient;
  const QString name = readablePerson(patient.name);
  patient_->setText(!document.isOpen() ? QString{} : name.isEmpty() ? tr("Patient without a name") : name);
  QStringList details;
  if (document.isOpen()) {
    if (!patient.id.empty()) details << QString::fromStdString(patient.id);
    if (!patient.sex.empty()) details << QString::fromStdString(patient.sex);
    if (!patient.birth_date.empty()) details << tr("born %1").arg(QString::fromStdString(patient.birth_date));
    if (patient.height_m) details << tr("%1 cm").arg(*patient.height_m * 100, 0, 'f', 0);
    if (patient.mass_kg) details << tr("%1 kg").arg(*patient.mass_kg, 0, 'f', 0);
    if (!patient.diagnosis.empty()) details << QString::fromStdString(patient.diagnosis);
  }
  details_->setText(details.join("  ·  "));
  saved_->setText(!document.isOpen() ? QString{} : document.isModified() ? tr("● Unsaved changes") : tr("Saved"));
}

}  // namespace sinew
