#include <cmath>
#include <map>
#include <sstream>

#include "app/cli/cli_test.h"

namespace {

/// A line of the CSV; what is empty there is NaN.
struct Row {
  int seed = 0, spp = 0;
  double seconds = NAN, scaled = NAN, relmse999 = NAN, estimate = NAN;
};

using Rows = std::map<std::string, std::vector<Row>>;  ///< by method, in the file's order

class ChartCommand : public CommandLine {
 protected:
  Rows read_rows(const std::string& name) const {
    std::istringstream lines(read(name));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "method,seed,spp,seconds,relmse_scaled,relmse999,relmse_scaled_estimate");
    Rows rows;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::string method, cell;
      std::getline(cells, method, ',');
      std::vector<double> values;
      while (std::getline(cells, cell, ',')) values.push_back(cell.empty() ? NAN : std::stod(cell));
      values.resize(6, NAN);
      rows[method].push_back(
          {static_cast<int>(values[0]), static_cast<int>(values[1]), values[2], values[3], values[4], values[5]});
    }
    return rows;
  }
  Result chart(const Arguments& options) const {
    Arguments arguments{"chart", scene, "-o", "a.svg", "--csv", "a.csv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return glimt(arguments);
  }
  void expect_refused(const Arguments& options, const Arguments& parts) const {
    const std::size_t before = files();
    const Result result = chart(options);
    EXPECT_EQ(result.status, 2) << result.err;
    for (const auto& part : parts) EXPECT_TRUE(has(result.err, part)) << part << " in " << result.err;
    EXPECT_EQ(files(), before) << "a file was written";
  }
};

/// relmse_scaled after so many samples.
double error_at(const std::vector<Row>& rows, int spp) {
  for (const Row& row : rows)
    if (row.spp == spp) return row.scaled;
  ADD_FAILURE() << "no row for " << spp << " spp";
  return NAN;
}

// The report leaves caustics out, so its picture converges to another one: from some sample count on its error is that
// of the model and samples buy nothing, while path and naive go on as 1/samples. That it is the caustics and not its
// other habits: with independent camera rays it flattens as well, and with caustics it goes on. The halves of the
// picture agree on what both leave out, so they cannot see that error.
TEST_F(ChartCommand, ReportFlattensAtItsMissingCausticsAndOthersGoOn) {
  const std::string independent = "report:sampler=independent", whole = independent + ":caustics=on";
  ASSERT_EQ(glimt({"render", scene, "-o", "r.exr", "--size", "24x24", "--spp", "32768", "--seed", "77"}).status, 0);
  const Result result = chart({"--size", "24x24", "--methods", "report,naive,path," + independent + "," + whole,
                               "--spp", "8192", "--seeds", "1", "--reference", "r.exr"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Rows rows = read_rows("a.csv");
  ASSERT_EQ(rows.size(), 5U);
  const auto fall = [&rows](const std::string& method) {
    return error_at(rows.at(method), 8192) / error_at(rows.at(method), 1024);
  };
  for (const auto& flat : {std::string("report"), independent}) EXPECT_GT(fall(flat), 0.5) << flat;
  for (const auto& method : {std::string("naive"), std::string("path"), whole}) EXPECT_LT(fall(method), 0.3) << method;
  EXPECT_LT(error_at(rows.at("path"), 8192), error_at(rows.at("report"), 8192)) << "the curves cross";
  const Row& last = rows.at(independent).back();
  EXPECT_LT(last.estimate, last.scaled / 4);
}

TEST_F(ChartCommand, WritesEveryPointOfEverySeedAndVariant) {
  const Result result = chart({"--size", "16x16", "--spp", "6", "--seeds", "2", "--set", "render.seed=5", "--methods",
                               "naive,path:sampler=sobol:shadow_rays=4"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Rows rows = read_rows("a.csv");
  ASSERT_EQ(rows.size(), 2U);
  for (const auto& [method, points] : rows) {
    ASSERT_EQ(points.size(), 8U) << method;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i].seed, i < 4 ? 5 : 6);
      EXPECT_EQ(points[i].spp, (std::vector<int>{1, 2, 4, 6})[i % 4]);
      EXPECT_GT(points[i].seconds, i % 4 == 0 ? 0 : points[i - 1].seconds) << "seconds add up";
      EXPECT_TRUE(std::isnan(points[i].scaled)) << "there is no reference";
      EXPECT_EQ(std::isnan(points[i].estimate), i % 4 == 0) << "one sample has one half";
    }
  }
  EXPECT_TRUE(rows.contains("path:sampler=sobol:shadow_rays=4"));
  const std::string svg = read("a.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n"));
  for (const char* part :
       {"Hexagonal room", ">naive<", ">path, sampler sobol, shadow rays 4<", "seconds", "relmse_scaled"})
    EXPECT_TRUE(has(svg, part)) << part;
  for (const char* part : {"naive", "path, sampler sobol, shadow rays 4", "efficiency"})
    EXPECT_TRUE(has(result.out, part)) << part;
}

// A variant's errors are those of the picture that `glimt render` makes with the same settings.
TEST_F(ChartCommand, ErrorsAreThoseOfTheRenderedPicture) {
  ASSERT_EQ(render("r.pfm", {"--spp", "64", "--seed", "9"}).status, 0);
  ASSERT_EQ(render("x.pfm", {"--spp", "4", "--method", "naive", "--sampler", "sobol"}).status, 0);
  ASSERT_EQ(chart({"--size", "24x16", "--spp", "4", "--seeds", "1", "--methods", "naive:sampler=sobol", "--reference",
                   "r.pfm"})
                .status,
            0);
  std::istringstream measures(glimt({"compare", "x.pfm", "r.pfm"}).out);
  std::map<std::string, double> compared;
  std::string name;
  for (double value = 0; measures >> name >> value;) compared[name] = value;
  const Rows rows = read_rows("a.csv");
  const Row& last = rows.at("naive:sampler=sobol").back();
  EXPECT_NEAR(last.scaled, compared.at("relmse_scaled"), 1e-6 * last.scaled);
  EXPECT_NEAR(last.relmse999, compared.at("relmse999"), 1e-6 * last.relmse999);
}

TEST_F(ChartCommand, RefusesWithAReason) {
  ASSERT_EQ(render("small.exr", {"--spp", "1"}).status, 0);
  ASSERT_EQ(render("other.exr", {"--spp", "1", "--set", "sphere.glass.radius=1"}).status, 0);
  write("broken.exr", "no picture");
  expect_refused({"--reference", "small.exr"}, {"small.exr", "400x400", "24x16"});
  expect_refused({"--reference", "other.exr", "--size", "24x16"}, {"other.exr", "another scene"});
  expect_refused({"--reference", "broken.exr", "--size", "24x16"}, {"broken.exr"});
  expect_refused({"--reference", "none.exr"}, {"none.exr"});
  expect_refused({"--methods", "path,pat"}, {"--methods pat", "nearest is \"path\"", "naive"});
  expect_refused({"--methods", "path:sampler=x"}, {"--methods path:sampler=x", "sobol"});
  expect_refused({"--methods", "path:samplr=sobol"}, {"--methods path:samplr=sobol", "sampler"});
  expect_refused({"--methods", "path:sampler"}, {"--methods path:sampler"});
  expect_refused({"--spp", "4", "--seconds", "1"}, {"--spp", "--seconds"});
  for (const char* seconds : {"0", "-1", "nan"}) expect_refused({"--seconds", seconds}, {"--seconds"});
  expect_refused({"--seeds", "0"}, {"--seeds"});
  EXPECT_TRUE(has(glimt({"chart", scene, "-o", "a.png"}).err, ".svg"));
  EXPECT_TRUE(has(glimt({"chart", scene, "-o", "none/a.svg"}).err, "does not exist"));
  EXPECT_TRUE(has(glimt({"chart", scene}).err, "--output"));
  EXPECT_EQ(glimt({"chart", scene}).status, 2);
  EXPECT_EQ(glimt({"chart", scene, "--ablate", "--csv", "a.csv"}).status, 2);
}

TEST_F(ChartCommand, TakesAReferenceOfItsSceneWhateverItsSettings) {
  ASSERT_EQ(render("r.exr", {"--spp", "4", "--sampler", "independent", "--shadow-rays", "2"}).status, 0);
  const Result result = chart({"--size", "24x16", "--spp", "2", "--seeds", "1", "--reference", "r.exr"});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(ChartCommand, AblationPrintsATableAndNeedsNoChart) {
  const Result result = glimt({"chart", scene, "--ablate", "--size", "24x24", "--spp", "4", "--seeds", "2"});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* part : {"4 spp, 2 seeds", "verdict", "fresnel schlick", "caustics off", "max depth 4",
                           "shadow rays 30", "sampler sobol", "light sampling none", "roulette constant",
                           "light paths 0.1", "Other light in mirrors and glass"})
    EXPECT_TRUE(has(result.out, part)) << part << " in " << result.out;
  EXPECT_FALSE(has(result.out, "roughness 0")) << "nothing here is rough";
  const Result matt =
      glimt({"chart", GLIMT_SCENES "/hexagon_empty.toml", "--ablate", "--size", "16x16", "--spp", "2", "--seeds", "1"});
  ASSERT_EQ(matt.status, 0) << matt.err;
  EXPECT_FALSE(has(matt.out, "Caustics")) << "all of its light is one family";
  EXPECT_FALSE(has(matt.out, "light paths"));
  EXPECT_EQ(files(), 0U);
}

}  // namespace
