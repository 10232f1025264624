#include "exchange/database.h"

#include <gmock/gmock.h>

#include "tests/replay/synthetic_run.h"

namespace reprise::exchange {
namespace {

using replay::Value;
using testing::ElementsAre;
using testing::HasSubstr;

class SqlOverATrace : public testing::Test {
  protected:
    std::vector<std::vector<Value>> ask(const std::string& sql) {
        std::vector<std::vector<Value>> rows;
        database_.query(
            sql,
            [](const auto&) {},
            [&](std::span<const Value> row) { rows.emplace_back(row.begin(), row.end()); });
        return rows;
    }

    std::string complaint(const std::string& sql) {
        return test::error_of([&] { ask(sql); });
    }

    static replay::TraceReader made(const std::filesystem::path& path) {
        test::write_trace(path, {.ticks = 150});
        return replay::TraceReader(path);
    }

    test::Folder folder_;
    replay::TraceReader trace_ = made(folder_ / "a.mcap");
    Database database_{trace_};
};

TEST_F(SqlOverATrace, SumsWhatTheReaderReads) {
    double sum = 0;
    std::int64_t count = 0;
    for (std::uint64_t index = 1; index <= trace_.ticks(); ++index)
        for (const world::CarState& car : trace_.tick(index).view.cars()) {
            sum += static_cast<double>(car.speed()) + car.position().x();
            ++count;
        }
    ASSERT_GT(count, 0);
    EXPECT_THAT(ask("select sum(speed + position_x), count(*) from cars"),
                ElementsAre(ElementsAre(Value(sum), Value(count))));
}

/// A condition on tick changes what is read, never what is answered.
TEST_F(SqlOverATrace, ConditionsOnTickAnswerAsWithoutTheirShortCut) {
    for (const char* condition : {"= 7",
                                  "< 7",
                                  "<= 7.5",
                                  "> 140.5",
                                  ">= 150",
                                  "between 60 and 70",
                                  "in (3, 64, 65, 999)",
                                  "= 7.5",
                                  "< -1",
                                  "> 1000",
                                  "< 'a'",
                                  "> 'a'",
                                  "= '7'",
                                  "is null",
                                  "= 9223372036854775807",
                                  "> 3 and tick < 9",
                                  "not between 2 and 149"}) {
        const std::string select = "select tick, id, speed from cars where ";
        EXPECT_EQ(ask(select + "tick " + condition), ask(select + "+tick " + condition))
            << condition;
    }
}

TEST_F(SqlOverATrace, JoinsTicksThatAreApart) {
    const auto rows =
        ask("select a.id, b.position_x - a.position_x from cars a join cars b on b.id = a.id and "
            "b.tick = a.tick + 70 where a.tick = 3");
    ASSERT_FALSE(rows.empty());
    for (const auto& row : rows) {
        const auto id = static_cast<std::uint32_t>(std::get<std::int64_t>(row[0]));
        const double before = world::find(trace_.tick(3).view.cars(), id)->position().x();
        const double after = world::find(trace_.tick(73).view.cars(), id)->position().x();
        EXPECT_EQ(std::get<double>(row[1]), after - before);
    }
}

TEST_F(SqlOverATrace, OrdersByTickWithoutSortingAndAgainstIt) {
    EXPECT_EQ(ask("select tick from ticks order by tick"),
              ask("select tick from ticks order by +tick"));
    EXPECT_THAT(ask("select tick from ticks order by tick desc limit 1"),
                ElementsAre(ElementsAre(Value(std::int64_t{150}))));
}

TEST_F(SqlOverATrace, WholeNumbersThatSqlCannotHoldAreTexts) {
    const std::uint64_t digest = trace_.tick(1).view.tick->digests()->state().low();
    EXPECT_THAT(ask("select cast(digests_state_low as text) from ticks where tick = 1"),
                ElementsAre(ElementsAre(Value(std::to_string(digest)))));
}

TEST_F(SqlOverATrace, MistakesComeWithASuggestion) {
    EXPECT_THAT(complaint("select sped from cars"), HasSubstr("did you mean 'speed'?"));
    EXPECT_THAT(complaint("select c.sped from cars c"), HasSubstr("did you mean 'speed'?"));
    EXPECT_THAT(complaint("select * from car"), HasSubstr("did you mean 'cars'?"));
    EXPECT_THAT(complaint("select 1; select 2"), HasSubstr("one statement"));
    EXPECT_THAT(complaint("create table mine(a)"), HasSubstr("only read"));
    EXPECT_THAT(complaint("attach 'other.db' as o; select 1"), HasSubstr("SQL:"));
    EXPECT_THAT(complaint(" ; "), HasSubstr("select count(*) from ticks"));
}

TEST_F(SqlOverATrace, DamageInTheFileIsAnErrorOfTheStatement) {
    const auto path = folder_ / "damaged.mcap";
    auto bytes = test::read_file(folder_ / "a.mcap");
    bytes[bytes.size() / 2] ^= 4;
    test::write_file(path, bytes);
    replay::TraceReader damaged(path);
    Database database(damaged);
    EXPECT_THAT(test::error_of([&] {
                    database.query(
                        "select sum(speed) from cars", [](const auto&) {}, [](auto) {});
                }),
                HasSubstr("is damaged"));
}

}  // namespace
}  // namespace reprise::exchange
