# Grading of flights with a rubric.

rubric-schema = unknown schema { $found }: this version reads schema { $known }
rubric-categories = { $found } categories: a rubric has four to six
rubric-elements = { $found } elements: a category has 1 to { $most }
rubric-id = an id has 1 to 24 lowercase letters, digits and `-`
rubric-id-twice = `{ $id }` is used twice
rubric-evidence = unknown evidence `{ $name }`
rubric-markers = list what can be observed: at least one text
rubric-translations = translations: { $found }, texts: { $count }
file-rubric = rubric

evidence-objectives-all = { $count ->
    [one] the objective was met
   *[other] all { $count } objectives were met
}
evidence-objectives = { $met } of { $count } objectives met; missed: { $missed }
evidence-alerts = { $in_time } of { $count } alerts answered in time, the slowest after { $slowest } s
evidence-alerts-unanswered = { $count ->
    [one] one alert, not answered
   *[other] { $count } alerts, none answered
}
evidence-refusals = { $failed } of { $count } commands failed or were refused
evidence-commands = { $count } commands, { $rate } a minute, { $percent } % of them for several vehicles
evidence-idle = vehicles in the air had no task for { $percent } % of the time
evidence-workload = busy with commands { $mean } % of the time, { $most } % in the busiest minute
evidence-hints = { $count ->
    [0] no hint taken
    [one] one hint taken
   *[other] { $count } hints taken
}
evidence-prediction = predicted { $predicted } points, reached { $score }
evidence-no-crash = no vehicle crashed
evidence-crashes = crashed: { $vehicles }
evidence-component = { $component } { $percent } %: { $cause }

grading-no-record = no flight of { $user } has been handed in
grading-unreadable = the grades in { $path } cannot be read: { $fault }
grading-no-trainee = no trainee: put the cursor on a seat, or write `class grade NAME`
grading-none = no flight is being graded: open one with `class grade`
grading-rate-first = first rate the element (`class rate`)
grading-no-bookmark = { $count ->
    [0] the flight has no bookmarks
   *[other] choose a bookmark from 1 to { $count }
}
grading-reading = another flight is being read: wait until it is shown
grading-oldest = there is no older flight
grading-newest = there is no newer flight
grading-foreign = they belong to another grader or rubric
grading-waits = the grades of { $count ->
    [one] { $count } flight
   *[other] { $count } flights
} are not written yet; the desk keeps them and tries again every minute: { $fault }
grading-written = all grades are written now
grading-ask-quit-reason = the grades of { $count ->
    [one] { $count } flight
   *[other] { $count } flights
} could not be written and are lost
grading-title = { $user }: { $mission }, { $score } points, { $when }  ({ $number }/{ $flights })
grading-rubric = { $rubric }, graded by { $grader }
grading-open = { $count ->
    [0] complete
    [one] one element is open
   *[other] { $count } elements are open
}
grading-scale = 1 very poor  2 poor  3 acceptable  4 good  5 very good  0 not observed
grading-needs-reason = 1 and 5 need a remark (`class remark`) or a bookmark (`class cite`)
grading-good = + { $marker }
grading-poor = - { $marker }
grading-evidence = record: { $evidence }
grading-remark = remark: { $text }
grading-cited = bookmarks: { $numbers }
grading-bookmark = ◆{ $number } { $time } { $text }
class-key-grade = grade
class-key-rate = rate 1–5, 0
class-key-remark = remark
class-key-cite = cite
argument-trainee = a trainee's user name
argument-rubric = the name of a rubric
argument-rating = 1 to 5, `unobserved`, or `clear`
argument-bookmark = the number of a bookmark

grades-none = No flight of the class has been graded yet: `class grade` at the desk begins.
grades-grader = grader
grades-open = open
grades-rubric = rubric
grades-element = element
grades-title = title
grades-rating = rating
grades-state = state
grades-counts = counts
grades-unobserved = not observed
grades-no-reason = no reason given
grades-remark = remark
grades-bookmarks = bookmarks, s
grades-agreement = { $first } and { $second }: { $marks } ratings by both, { $equal } equal, { $within } at most one step apart; mean difference { $difference }, weighted kappa { $kappa }; observed by one only: { $single }
grades-apart = { $user }, { $record }, { $element }: { $one } and { $other }
