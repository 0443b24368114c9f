/* Counts the rules of require-that that the last run of a model has broken. */
#include "cli/cure/broken_rules.h"

#include <stdio.h>

cli_broken_rules cli_rules_broken(const vs_scheme *scheme) {
  cli_broken_rules broken = { 0, 0 };
  vs_rule_info rule;
  for (size_t i = 0; vs_rule_get(scheme, i, &rule); i++)
    if (rule.shortfall > 0) broken.count++, broken.shortfall += rule.shortfall;
  return broken;
}

vs_outcome cli_rules_hold(const vs_scheme *scheme) {
  const size_t count = cli_rules_broken(scheme).count;
  if (!count) return VS_OUTCOME_DONE;
  fprintf(stderr, "vs: --strict: %zu %s not met\n", count, count == 1 ? "rule is" : "rules are");
  return VS_OUTCOME_MODEL;
}
