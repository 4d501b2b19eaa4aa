#pragma once

/// The keys of the study file of an optimisation with their meaning, as study_keys.hpp has those of a study.

#include "studies/optimise/design.hpp"
#include "studies/study/study_keys.hpp"

namespace rollres {

inline constexpr std::array design_keys{
    FileKey{"$schema", "schema of this file, for editors", a_text},
    FileKey{"study", "name of the study in the database", a_name, is_needed},
    FileKey{"comment", "what the study is about: the title of its report", a_text},
    FileKey{"scene", "name of a scene file, relative to this file, or a scene; the variables may be missing in it",
            KeyForm{}, is_needed},
    FileKey{"set", "inputs that replace those of the scene"},
    FileKey{"variables",
            "inputs to be chosen, each between two bounds or from a list; under variant named sets of them", KeyForm{},
            is_needed},
    FileKey{"compute", "outputs, and formulas with a name that goals, constraints and questions may use"},
    FileKey{"minimise", "formula of inputs and outputs to be made small"},
    FileKey{"maximise", "formula of inputs and outputs to be made large"},
    FileKey{"scenes", "duty cycle: inputs and weight of each scene"},
    FileKey{"over_scenes", "how the goals' values in the scenes become one, unless a goal says so itself",
            one_of(ChoiceNames<OverScenes>::names)},
    FileKey{"constraints", "conditions of inputs and outputs that hold in every scene, or over all"},
    FileKey{"uncertain", "inputs that scatter: their distributions, correlations and points"},
    FileKey{"algorithm", "algorithm of the search; left out: chosen from the problem",
            one_of(ChoiceNames<Algorithm>::names)},
    FileKey{"global", "whether to look for the best of several optima", yes_or_no},
    FileKey{"stop", "when the search ends"},
    FileKey{"pareto", "a second goal, for a front between the two"},
};

inline constexpr std::array goal_keys{
    FileKey{"formula", "of inputs and outputs", a_name, is_needed},
    FileKey{"over", "how its values in the scenes become one: weighted sum (the default) or mean, largest or least",
            one_of(ChoiceNames<OverScenes>::names)},
    FileKey{"scatter", "what of the scatter is meant: mean (the default), mean + 2 sd, sd, P90", a_name},
};

inline constexpr std::array constraint_keys{
    FileKey{"condition", "of inputs and outputs", a_name, is_needed},
    FileKey{"over", "number of the scenes for which it holds; left out: in each of them",
            one_of(ChoiceNames<OverScenes>::names)},
    FileKey{"scatter", "what of the scatter it holds for: mean, mean + 2 sd, P95", a_name},
};

inline constexpr std::array variable_keys{
    FileKey{"from", "lowest value", a_number, is_needed},
    FileKey{"to", "highest value", a_number, is_needed},
    FileKey{"scale", "how the search sees it; default: logarithmic where both bounds are positive",
            one_of(spacing_names)},
    FileKey{"start", "where the search starts; default: the scene's value, else the middle", a_number},
};

inline constexpr std::array duty_keys{
    FileKey{"set", "inputs that replace those of the scene"},
    FileKey{"weight", "of this scene's value in a sum or mean; default 1", a_positive},
};

inline constexpr std::array stop_keys{
    FileKey{"evaluations",
            "most scenes that the searches may ask for, recalled ones included, slopes once begun being finished; "
            "default: for each scene 100, with global 300, times the number of variables and one",
            whole_from(1, most_points)},
    FileKey{"tolerance", "of each variable, as a fraction of its range; default 1e-4"},
};

inline constexpr std::array pareto_keys{
    FileKey{"minimise", "formula of inputs and outputs to be made small"},
    FileKey{"maximise", "formula of inputs and outputs to be made large"},
    FileKey{"points", "designs on the front, both ends included", whole_from(2, most_points), is_needed},
};

}  // namespace rollres
