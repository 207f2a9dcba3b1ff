// The command line and --config as a newcomer writes them: what is wrong is told at once, by name.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/command_line.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <sstream>

namespace eikonal::tool {

namespace {

/// Single changes of a letter from one word to the other (Levenshtein's distance).
size_t distance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t corner = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, corner + (a[i - 1] != b[j - 1])});
            corner = above;
        }
    }
    return row.back();
}

/// The tool's own options, and those of the subcommand that was given.
std::vector<const CLI::Option*> optionsOf(const CLI::App& app) {
    std::vector<const CLI::Option*> options = app.get_options();
    for (const CLI::App* given : app.get_subcommands())
        for (const CLI::Option* option : given->get_options()) options.push_back(option);
    return options;
}

/// "" or " (did you mean --size?)", for a name without its dashes.
std::string suggestion(const CLI::App& app, const std::string& unknown, const std::string& dashes) {
    std::vector<std::string> names;
    for (const CLI::Option* option : optionsOf(app))
        if (!option->get_group().empty()) // those without are left out of --help, too
            for (const std::string& name : option->get_lnames()) names.push_back(name);
    const std::string meant = likest(unknown, names);
    return meant.empty() ? "" : " (did you mean " + dashes + meant + "?)";
}

std::vector<const CLI::App*> subcommandsOf(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Null where there is none of that name.
const CLI::App* subcommandOf(const CLI::App& app, const std::string& name) {
    for (const CLI::App* known : subcommandsOf(app))
        if (known->get_name() == name) return known;
    return nullptr;
}

bool isBare(const std::string& value) {
    return !value.empty() && std::string("[\"'").find(value.front()) == std::string::npos;
}

/// CLI11's format, which would take a list without brackets for several values of an option.
class PlainConfig : public CLI::ConfigBase {
public:
    explicit PlainConfig(const CLI::App& app) : mApp(app) {}

    std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
        std::stringstream quoted;
        for (std::string line; std::getline(input, line);)
            quoted << quoteList(std::string(withoutByteOrderMark(line))) << "\n";
        std::vector<CLI::ConfigItem> read = ConfigBase::from_config(quoted);
        for (CLI::ConfigItem& item : read) checkItem(item);
        return read;
    }

private:
    static std::string quoteList(const std::string& line) {
        const size_t equals = line.find('=');
        const std::string name = CLI::detail::trim_copy(line.substr(0, equals));
        if (equals == std::string::npos || name.empty() || !isBare(name) || name.front() == '#' ||
            name.front() == ';')
            return line;
        std::string value = CLI::detail::trim_copy(line.substr(equals + 1));
        value = CLI::detail::trim_copy(value.substr(0, value.find('#')));
        if (!isBare(value) || value.find(',') == std::string::npos) return line;
        value.erase(std::remove(value.begin(), value.end(), ' '), value.end());
        return name + "=\"" + value + "\"";
    }

    void checkItem(CLI::ConfigItem& item) const {
        if (item.name == "++" || item.name == "--") return; // a section begins, ends
        const CLI::App* app = &mApp;                        // or the subcommand of a section
        for (const std::string& name : item.parents)
            if (app != nullptr) app = subcommandOf(*app, name);
        const CLI::Option* const option =
            app == nullptr ? nullptr : app->get_option_no_throw("--" + item.name);
        if (option == nullptr)
            throw UsageError(mApp.get_config_ptr()->as<std::string>() + ": no option '" +
                             item.fullname() + "'" + suggestion(mApp, item.name, ""));
        // An array in brackets is a vector's components as well.
        if (option->get_items_expected_max() == 1 && item.inputs.size() > 1)
            item.inputs = {join(item.inputs, ",")};
    }

    const CLI::App& mApp;
};

std::string firstLine(const std::string& text) {
    const std::string line = split(text, '\n').front();
    return line.empty() ? "unknown error" : line;
}

std::string nameOf(const CLI::Option& option) {
    return option.get_lnames().empty() ? option.get_type_name()
                                       : "--" + option.get_lnames().front();
}

std::string missingOptions(const CLI::App& app, const std::vector<Alternatives>& alternatives) {
    std::vector<std::string> missing;
    if (app.get_subcommands().size() < app.get_require_subcommand_min()) {
        std::vector<std::string> names;
        for (const CLI::App* known : subcommandsOf(app)) names.push_back(known->get_name());
        missing.push_back("one of " + join(names, ", "));
    }
    for (const CLI::Option* option : optionsOf(app))
        if (option->get_required() && option->count() == 0) missing.push_back(nameOf(*option));
    for (const auto& [group, unless] : alternatives)
        if (std::none_of(group.begin(), group.end(),
                         [&](const std::string& name) { return app.count(name) > 0; }) &&
            !(unless && unless()))
            missing.push_back(join(group, " or "));
    return join(missing, ", ");
}

/// What was given and no option has taken; "" if there is nothing.
std::string unknownArguments(const CLI::App& app) {
    std::vector<std::string> options, others;
    for (const std::string& argument : app.remaining(true)) {
        const std::string name = argument.substr(0, argument.find('='));
        const size_t letters = name.find_first_not_of('-');
        if (letters == 0 || letters == std::string::npos)
            others.push_back("'" + argument + "'");
        else
            options.push_back(name + suggestion(app, name.substr(letters), "--"));
    }
    if (!options.empty()) return "no such option: " + join(options, ", ");
    if (!others.empty() && !subcommandsOf(app).empty() && app.get_subcommands().empty()) {
        std::vector<std::string> names;
        for (const CLI::App* known : subcommandsOf(app)) names.push_back(known->get_name());
        const std::string given = app.remaining(true).front(), meant = likest(given, names);
        return "no such kind: '" + given + "'" +
               (meant.empty() ? ", expected one of " + join(names, ", ")
                              : " (did you mean " + meant + "?)");
    }
    return others.empty() ? "" : "not expected: " + join(others, ", ");
}

} // namespace

std::string likest(const std::string& unknown, const std::vector<std::string>& known) {
    std::string best;
    size_t least = std::max<size_t>(2, unknown.size() / 3) + 1; // beyond, it is another word
    for (const std::string& name : known) {
        const bool begun = unknown.size() > 1 && name.rfind(unknown, 0) == 0;
        const size_t away = begun ? 1 : distance(unknown, name);
        if (away >= least || away >= name.size()) continue;
        least = away;
        best = name;
    }
    return best;
}

void acceptPlainLists(CLI::App& app) {
    app.config_formatter(std::make_shared<PlainConfig>(app));
}

bool parseCommandLine(CLI::App& app, int argc, char** argv,
                      const std::vector<Alternatives>& alternatives) {
    std::string wrong;
    try {
        app.parse(argc, argv);
    } catch (const CLI::FileError& error) {
        throw MissingError(firstLine(error.what()));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            app.exit(error);
            return false;
        }
        const bool absent = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
        const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
        if (!absent && !extra) throw UsageError(firstLine(error.what()));
        wrong = unknownArguments(app);
        if (absent && wrong.empty() && missingOptions(app, alternatives).empty())
            throw UsageError(firstLine(error.what()));
    }
    if (wrong.empty()) {
        const std::string missing = missingOptions(app, alternatives);
        if (!missing.empty()) wrong = "not given: " + missing;
    }
    if (!wrong.empty()) throw UsageError(wrong + " (--help lists the options)");
    return true;
}

} // namespace eikonal::tool
