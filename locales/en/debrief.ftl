# The debrief, 80 columns wide.

debrief-head = DEBRIEF  { $mission } r{ $revision }   { $title }   { $outcome }
debrief-score = Score { $score } / 1000   grade { $grade }   { $medal }   seed { $seed }   { $backend }
debrief-no-medal = no medal
debrief-embedded = embedded
debrief-time = Time { $used } (par { $par }, limit { $limit })   Energy { $energy }   Drones { $count }
debrief-energy = { $used } Wh (par { $par })
debrief-energy-unknown = not reported

# Headings stand over columns: at most 36 for the objectives, 13 for the result, 11 for the target,
# 12 for the components, 6 for weight and value, 8 for points.
debrief-objectives = OBJECTIVES
debrief-result = result
debrief-target = target
debrief-points = points
debrief-components = COMPONENTS
debrief-weight = weight
debrief-value = value
debrief-moved = what moved it
# At most 8 columns.
debrief-sum = score
debrief-gold-needs = gold needs { $gates }

debrief-timeline = TIMELINE   (> command  o objective  ! alert  x rule broken  r rejected)
debrief-drone = drone { $vehicle }: { $what }
debrief-vehicle = vehicle { $vehicle }: { $what }

debrief-improve = WHAT TO IMPROVE   (biggest gain first)
debrief-nothing = Nothing that would bring another point.
# At most 5 columns.
debrief-good = good

debrief-last-mission = there is no mission after this one
