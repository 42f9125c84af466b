#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/error.h"
#include "solvers/registry.h"
#include "solvers/variant_text.h"

namespace conebench::solvers {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names(std::string_view variants) {
  std::vector<std::string> result;
  for (const Solver& solver : make_solvers(variants)) result.push_back(solver.name);
  return result;
}

std::string error_of(std::string_view variant) {
  try {
    make_solvers(variant);
  } catch (const problems::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Variant, OmitsDefaultsAndSortsKeys) {
  EXPECT_THAT(names("gs"), ElementsAre("gs"));
  EXPECT_THAT(names("gs[omega=1.0,local=exact]"), ElementsAre("gs"));
  EXPECT_THAT(names(" gs[ omega=0.8, local=projection ] "),
              ElementsAre("gs[local=projection,omega=0.8]"));
}

TEST(Variant, ListsMakeGrids) {
  EXPECT_THAT(
      names("gs[omega=0.8,1.0,local=exact,projection]"),
      ElementsAre("gs[omega=0.8]", "gs[local=projection,omega=0.8]", "gs", "gs[local=projection]"));
}

TEST(Variant, NamesWhatItDoesNotKnow) {
  EXPECT_THAT(error_of("gss"), HasSubstr("no solver 'gss' (did you mean 'gs'?)"));
  EXPECT_THAT(error_of("gs[omga=1]"), HasSubstr("no parameter 'omga' (did you mean 'omega'?)"));
  EXPECT_THAT(error_of("gs[omega=2.5]"), HasSubstr("omega is 2.5, expected 0.05 to 1.95"));
  EXPECT_THAT(error_of("gs[omega=fast]"), HasSubstr("expected a number"));
  EXPECT_THAT(error_of("gs[omega=nan]"), HasSubstr("omega is nan"));
  EXPECT_THAT(error_of("gs[local=exakt]"), HasSubstr("did you mean 'exact'?"));
  EXPECT_THAT(error_of("gs[omega=1"), HasSubstr("without a final ']'"));
  EXPECT_THAT(error_of("gs[1.0]"), HasSubstr("expected name[key=value,...]"));
  EXPECT_THAT(error_of(""), HasSubstr("no solver ''"));
  EXPECT_THROW(make_solver("gs[omega=0.8,1.0]"), problems::InputError);
}

TEST(Variant, WithoutAFinalBracketAFileIsAllName) {
  EXPECT_EQ(parse_file_variant(" exec:/a [b]/c ").name, "exec:/a [b]/c");
  const VariantText text = parse_file_variant("exec:/a [b]/c[k=1,2,j=x]");
  EXPECT_EQ(text.name, "exec:/a [b]/c");
  ASSERT_EQ(text.items.size(), 2u);
  EXPECT_THAT(text.items[0].values, ElementsAre("1", "2"));
  EXPECT_EQ(text.combinations().size(), 2u);
  EXPECT_EQ(variant_text(text.name, text.combinations()[1]), "exec:/a [b]/c[j=x,k=2]");
  EXPECT_EQ(variant_text("gs", {}), "gs");
}

TEST(Variant, EveryMethodDocumentsItsParameters) {
  for (const Method& method : all_methods()) {
    EXPECT_FALSE(method.summary.empty()) << method.name;
    for (const Parameter& parameter : method.parameters) {
      EXPECT_FALSE(parameter.doc.empty()) << method.name << " " << parameter.name;
    }
    EXPECT_EQ(make_solver(method.name).name, method.name);
  }
}

}  // namespace
}  // namespace conebench::solvers
