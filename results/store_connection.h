#pragma once

// Internal to the store: the questions that its functions are made of. See results/store.h.

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "problems/error.h"
#include "results/store.h"

namespace conebench::results {

/// A number, where NULL stands for infinite.
double number(const SQLite::Column& column);

struct Store::Connection {
  using Contender = std::pair<std::string, std::int64_t>;  ///< and its id

  explicit Connection(const std::filesystem::path& file);

  /// Asks something; a damaged file is the caller's bad input, whenever it shows.
  template <class Question>
  auto ask(const Question& question) {
    try {
      return question();
    } catch (const SQLite::Exception& error) {
      throw problems::InputError(path, error.what());
    } catch (const nlohmann::json::exception& error) {
      throw problems::InputError(path, error.what());
    }
  }

  std::vector<std::pair<Settings, std::int64_t>> settings();  ///< and their ids, by id
  std::int64_t id_of(const Settings& wanted);                 ///< InputError if there are none such
  std::vector<double> tolerances(std::int64_t settings);      ///< falling
  std::vector<Contender> contenders(std::int64_t settings);   ///< in alphabetical order
  std::unordered_map<std::int64_t, ProblemId> problems();     ///< by id

  /// InputError, naming the tolerances there are, unless `tol` is one.
  void check_tolerance(std::int64_t settings, double tol);

  /// Rows of `outcome` at one tolerance: `use` gets the contender's place in `contenders` and a row
  /// of problem_id, time_s, status_id, compared.
  template <class Use>
  void for_each_outcome(std::int64_t settings, double tol, const std::vector<Contender>& contenders,
                        const Use& use) {
    check_tolerance(settings, tol);
    SQLite::Statement row(database,
                          "SELECT problem_id, time_s, status_id, compared FROM outcome WHERE "
                          "settings_id = ? AND tol = ? AND contender_id = ?");
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      row.reset();
      row.bind(1, settings);
      row.bind(2, tol);
      row.bind(3, contenders[i].second);
      while (row.executeStep()) use(i, row);
    }
  }

  /// By id; of one problem if its content is given.
  std::vector<Record> records(const std::string& content_sha256 = "");

  std::string path;
  SQLite::Database database;
};

}  // namespace conebench::results
