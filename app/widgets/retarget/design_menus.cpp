#include "app/widgets/retarget/design_menus.h"

#include <QMenu>
#include <QToolButton>

#include "app/model/retarget/design_files.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"

namespace sinew {
namespace {

QToolButton* makeMenuButton(const QString& object_name, const QString& text, const QString& icon_name,
                            const QString& tip, QMenu* menu) {
  auto* button = new QToolButton;
  button->setObjectName(object_name);
  button->setText(text);
  button->setIcon(icon(icon_name));
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setProperty("words", true);
  button->setProperty("menu", true);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setMenu(menu);
  menu->setObjectName(object_name + "_menu");
  menu->setToolTipsVisible(true);
  return button;
}

}  // namespace

DesignMenus::DesignMenus(Workspace& workspace, DesignDocument& document, BodySolver& solver, QWidget& window)
    : QObject{&window}, workspace_{workspace}, document_{document}, solver_{solver}, window_{&window} {
  auto* presets = new QMenu{window_};
  patient_ = presets->addAction(tr("This patient"), this, &DesignMenus::patientWanted);
  patient_->setObjectName("preset_patient");
  patient_->setToolTip(tr("The bones of the open case, its muscles retargeted; before the examination"));
  presets->addSeparator();
  for (const auto& name : shapePresetNames()) {
    auto* action = presets->addAction(readableName(name), this, [this, name] { takePreset(name); });
    action->setObjectName("preset_" + QString::fromStdString(name));
  }
  presets->addSeparator();
  presets->addAction(tr("From a file …"), this, &DesignMenus::openBodyFile)->setObjectName("preset_file");
  auto* files = new QMenu{window_};
  const auto file = [&](const char* object_name, const QString& text, const QString& tip, auto call) {
    auto* action = files->addAction(text, this, call);
    action->setObjectName(object_name);
    action->setToolTip(tip);
  };
  file("save_body", tr("Save body …"), tr("Shape, masses and strengths, as JSON"), &DesignMenus::saveBodyFile);
  file("save_model", tr("Save model …"), tr("The retargeted model with edited ranges, as JSON"),
       &DesignMenus::saveModelFile);
  file("export_model", tr("Export model …"), tr("For other programs"), &DesignMenus::exportFile);
  bodies_ = makeMenuButton("preset_button", tr("Body"), "patient", tr("Take a body: a preset, or a file"), presets);
  files_ = makeMenuButton("files_button", tr("Save, export"), "save", tr("Save the body or the model, or export it"),
                          files);
  connect(&writing_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) emit workspace_.problem(message);
  });
}

void DesignMenus::offerPatient(bool there) {
  patient_->setEnabled(there);
  patient_->setText(there ? tr("This patient") : tr("This patient: no bones fitted"));
}

void DesignMenus::report(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    emit workspace_.problem(QString::fromUtf8(error.what()));
  }
}

void DesignMenus::takePreset(const std::string& name) {
  report([&] {
    const BodyDescription body = loadShapePreset(workspace_.resourceDir(), name);
    document_.edit(tr("Take the %1").arg(QString::fromStdString(name)), [&](RetargetDesign& d) { d.body = body; });
  });
}

void DesignMenus::openBodyFile() {
  const auto file = askForFile(window_, tr("Body"), tr("Bodies (*.json)"));
  if (file.empty()) return;
  report([&] {
    BodyDescription body = loadBodyDescription(file);
    if (body.name == kPatientBody) body.name = "body from a file";  // whose it was the file does not say
    document_.edit(tr("Open a body"), [&](RetargetDesign& d) { d.body = body; });
  });
}

void DesignMenus::saveBodyFile() {
  const auto file = askForNewFile(window_, tr("Body"), "body.json", tr("Bodies (*.json)"));
  if (file.empty()) return;
  report([&] {
    saveBodyDescription(document_.current().body, file);
    emit workspace_.notice(tr("Saved: %1").arg(QString::fromStdString(file.filename().string())));
  });
}

bool DesignMenus::isSolvedOr(const QString& wanted_for) {
  if (solver_.isCurrent()) return true;
  emit workspace_.problem(
      tr("%1: the muscles are not retargeted yet; wait, or undo the last change").arg(wanted_for));
  return false;
}

void DesignMenus::saveModelFile() {
  if (!isSolvedOr(tr("Save model"))) return;
  const auto file = askForNewFile(window_, tr("Model"), "model.json", tr("Sinew models (*.json)"));
  if (file.empty()) return;
  writeInBackground(file, [model = solver_.body()->model, file] {
    saveModel(*model, file);
    return std::string{};
  });
}

void DesignMenus::exportFile() {
  if (!isSolvedOr(tr("Export model"))) return;
  const auto file = askForNewFile(window_, tr("Export"), "model.osim", exportFilter());
  if (file.empty()) return;
  writeInBackground(file, [model = solver_.body()->model, file] { return exportModel(*model, file); });
}

void DesignMenus::writeInBackground(const std::filesystem::path& file, std::function<std::string()> write) {
  const QString name = QString::fromStdString(file.filename().string());
  writing_.post(tr("Writing"), [this, name, write = std::move(write)](const Job&) -> JobRunner::Finish {
    const QString remark = QString::fromStdString(write());
    return [this, name, remark] {
      emit workspace_.notice(remark.isEmpty() ? tr("Saved: %1").arg(name) : tr("Exported: %1. %2").arg(name, remark));
    };
  });
}

}  // namespace sinew
