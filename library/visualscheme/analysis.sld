; Analysis of models: structures, heat, plans, and searches. Units are metre, newton, pascal and kilogram.
(define-library (visualscheme analysis)
  (export members-of nodes-where nearest-node faces-on snow-load wind-pressure design-cases size-frame member-section shell-count shell-forces shell-stress shell-picture moment-lines reaction-arrows
    frame frame? frame-solve displacement rotation reaction reaction-moment member-force member-forces case-names combine-cases utilisation
    member-displacement buckling-modes vibration-modes mode? mode-value mode-curves deformed frame-picture color-legend
    u-value heat-balance load-epw weather? weather-place weather-hours irradiance monthly-sums monthly-means hourly-heat
    view-factor daylight-factor illuminance grid-points grid-faces faces-in sun-hours-on color-faces
    walking-speed flow-time egress-time rooms-of-cut turning-area areas-by-use
    carbon glass-share pareto-front pareto-set
    egress egress-distance egress-path longest-egress isovist optimise
    round-section tube-section rectangle-section box-section any-section section? section-area
    structural-material structural-material?)
  (import (visualscheme) (analysis core))
  (include "analysis/sections.scm" "analysis/frames.scm" "analysis/results.scm" "analysis/actions.scm" "analysis/timber.scm" "analysis/checks.scm"
           "analysis/sizing.scm" "analysis/deformation.scm" "analysis/diagrams.scm" "analysis/members.scm" "analysis/modes.scm" "analysis/heat.scm" "analysis/weather.scm" "analysis/hourly_heat.scm" "analysis/light.scm" "analysis/plans.scm" "analysis/people.scm"
           "analysis/quantities.scm" "analysis/search.scm" "analysis/goals.scm"))
