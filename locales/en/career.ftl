# Profiles and progress on the command line.
mastery-unknown = not tried
mastery-learning = learning
mastery-mastered = mastered
mastery-due = due for review
lack-chance = probability { $percent } %
lack-flights = { $count ->
    [one] another flight
   *[other] { $count } more flights
}
lack-missions = { $count ->
    [one] another mission
   *[other] { $count } more missions
}
lack-days = { $count ->
    [one] a flight on another day
   *[other] flights on { $count } more days
}

mission-state-locked = locked
mission-state-open = open
mission-state-passed = passed

part-for-sale = { $part }: { $price } credits, `sortie profile buy { $id }`
part-locked = { $part }: on sale once "{ $mission }" is passed
parts-missing = { $design } has parts that { $profile } does not own

profile-created = profile { $name } created; fly with `--profile { $name }`
profile-none = no profiles yet; `sortie profile create NAME` creates one
profile-choose = no profile chosen; profiles: { $known }. Use `--profile NAME`, or set `profile` in the configuration
profile-delete = this deletes { $name } with all flights ({ $flights }): add `--yes`; `sortie profile export { $name }` keeps a copy
profile-deleted = profile { $name } deleted
profile-imported = profile { $name } imported, flights: { $flights }, none of them verified
import-left-out = { $id } is left out: { $why }
import-practice = { $id }: { $why }
import-twice = it appears twice in the file
import-no-report = it has no report
import-unfit = its report is inconsistent: { $fault }
import-fleet = its designs cannot fly this mission
profile-bought = { $part } bought for { $price } credits; { $left } left
profile-not-stored = the flight is not stored: { $fault }
profile-record = with a profile, sortie records runs in the profile's data folder and counts the tries: leave out `--record` and `--try`
profiles-damaged = { $path } contains data that sortie did not write: { $fault }
profiles-recovered = a finished flight of { $profile } was missing and is stored now: { $mission }, { $score } points
profiles-left-attempt = { $profile }: mission { $mission } was cut off before its end: its record stops there, and nothing is known of the rest; it counts as given up, with { $score } points
profiles-left-exam = { $profile }: exam { $mission } was left early; it counts with { $score } points

progress-title = Progress of { $name }
progress-standing = { $credits ->
    [one] 1 credit
   *[other] { $credits } credits
}, level { $level } ({ $experience } of { $next } experience), licence for { $licence ->
    [one] 1 drone
   *[other] { $licence } drones
}, flights: { $flights }
progress-next = next: train { $skill } with { $mission }
progress-aids = advice: { $aids }
progress-lang = language: { $lang }
progress-since = since { $day }
progress-missions = Missions
progress-skills = Skills
progress-flown-by = flown by
flown-by-hand = hand
flown-by-script = script
flown-by-bundled-pilot = bundled pilot
progress-runs = Flights
progress-trainee = trainee
progress-mission = mission
progress-state = state
progress-medal = medal
progress-best = best
progress-tries = tries
progress-first = first
progress-last = last
progress-trend = change per try
progress-why = why locked
progress-skill = skill
progress-chance = probability
progress-mastery = mastery
progress-shown = evidence
progress-due = due
progress-ended = ended (UTC)
progress-score = score
progress-passed = passed
progress-stake = counts as
progress-seed = seed
progress-recording = record
progress-is-imported = imported
progress-imported = imported, not verified: { $count } of the flights
aids-full = full
aids-fading = fading
aids-none = none
stake-graded = graded
stake-practice = practice
stake-exam = exam
stake-daily = daily
answer-yes = yes
answer-no = no
profile-member = { $name }: { $credits ->
    [one] 1 credit
   *[other] { $credits } credits
}, level { $level }, licence for { $licence ->
    [one] 1 drone
   *[other] { $licence } drones
}, flights: { $flights }
