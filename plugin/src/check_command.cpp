// SPDX-License-Identifier: Apache-2.0
#include "check_command.h"

#include "check_report.h"
#include "command_options.h"
#include "progress_bar.h"

namespace tautline {
namespace {

/** Reads a model without the elements that are not known, if it can be read without them. */
CheckedModel readModel(const std::filesystem::path& file, std::vector<std::string> ignored,
                       const std::vector<std::string>& settings) {
    CheckedModel read;
    try {
        read.description = models::readOsimFile(file, {ignored, false, settings});
        return read;
    } catch (const models::UnknownElementsError& error) {
        read.unknown = error.getElements();
        for (const models::UnknownElement& element : read.unknown) {
            if (!element.whyNeeded.empty()) throw;
            ignored.push_back(element.type);
        }
    }
    read.description = models::readOsimFile(file, {ignored, false, settings});
    return read;
}

}  // namespace

void CheckCommand::declare(CLI::App& app) {
    addModelOptions(app, modelFile, ignored, settings);
    app.add_flag("--json", printsJson, "print all of it as JSON");
}

int CheckCommand::run(std::ostream& out, bool isTerminal) const {
    CheckedModel model = readModel(modelFile, ignored, settings);
    ProgressBar bar(out, isTerminal && !printsJson);
    model.check = models::checkModel(model.description, [&bar](double share) { bar.show(share); });
    bar.clear();
    if (printsJson)
        printCheckAsJson(model, out);
    else
        printCheck(model, out);
    return model.unknown.empty() ? 0 : 3;
}

}  // namespace tautline
