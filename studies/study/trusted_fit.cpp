#include "studies/study/trusted_fit.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "db/rows/schema.hpp"
#include "fitting/fit/fit_report.hpp"

namespace rollres {

FitRecord trusted_fit(const Json& given, const std::filesystem::path& file, const std::string& owner,
                      std::string_view key) {
  if (!given.is_object()) refuse(owner, key, given, "must be an object with name and db");
  const std::string place = owner + ": " + std::string(key);
  refuse_unknown_keys(given, stored_fit_keys, place);
  const std::string name = needed_text(given, "name", place, "must be the name of a fit");
  const std::string database = needed_text(given, "db", place, "must be the database that holds the fit");
  const std::filesystem::path path = file.parent_path() / database;
  std::optional<FitRecord> fit = find_fit(open_database(path, Access::read), name);
  if (!fit) refuse(place, "name", name, path.string() + " holds no fit of this name");
  const bool earlier = fit->status == "USABLE";  // as GOOD was called
  if (!earlier && fit->status != name_of(FitStatus::good) && fit->status != name_of(FitStatus::usable_with_warnings))
    throw std::invalid_argument(place + " " + name + ": its status is " + fit->status + ": its errors tell nothing");
  return std::move(*fit);
}

double trusted_error(const FitParameterRecord& parameter) {
  if (!std::isfinite(parameter.standard_error) || !(parameter.standard_error > 0))
    throw std::invalid_argument("its parameter " + parameter.name + " has no standard error" +
                                (parameter.flag.empty() ? "" : ": " + parameter.flag));
  return parameter.standard_error;
}

}  // namespace rollres
