# The trainee's profile, progress, and next step.

room-standing = standing
action-standing = show your progress: skills, scores, credits
action-daily = fly the mission with the seed of the day
action-exam = fly the mission's exam
action-practise = fly the mission for practice, with any seed
action-profiles = choose a profile
action-aids = change how much advice you get
keys-list = lists to choose from
hint-trainee = profile
hint-mission = mission
hint-aids = advice

# The first line of the home screen.
home-no-profile = choose a profile: without one, results are not kept
home-trainee = level { $level }   { $credits } cr   licence { $licence }
home-next = next: { $skill } { $percent } %, { $mission }
home-next-new = next: { $skill } (not tried), { $mission }
home-next-short = next: { $mission }
home-career = for your career
# At most 8 columns each.
home-locked = locked
home-is-next = next
home-sign-passed = passed
home-sign-next = next
home-sign-due = passed, a skill is due
home-sign-locked = locked
home-daily = seed of the day
home-exam = exam
home-practise = practice
home-seed-none = a seed is a whole number, 0 or more
ask-exam = START the exam
ask-exam-reason = a layout of your own, real time, no hints, no pause; the result counts

# The role of a mission in the career: labels and values.
mission-career = for your career
fact-stage = state
fact-locked = locked: { $why }
fact-practice = practice only: { $why }
fact-new = open, not flown yet
fact-practised = open, { $count ->
    [one] { $count } flight
   *[other] { $count } flights
} for practice
fact-exam = exam
fact-exam-passed = passed, { $score } points
fact-exam-failed = not passed, { $score } points
fact-no-points = open, no points in { $count ->
    [one] { $count } flight
   *[other] { $count } flights
}
fact-open = open, best { $score } points in { $count ->
    [one] { $count } flight
   *[other] { $count } flights
}
fact-passed = passed, { $score } points, { $medal }, { $count ->
    [one] { $count } flight
   *[other] { $count } flights
}
fact-next = next
fact-next-is = this one: it trains { $skill }
fact-next-drill = "{ $drill }": it trains { $skill }
fact-review = due
fact-trains = trains, %
fact-skill = { $skill } { $percent }
fact-skills-new = { $skills } (not tried)
fact-skill-mastered = { $skill } { $percent } (mastered)
fact-pays = pays
fact-pays-first = up to { $credits } cr for the first pass
fact-pays-nothing = no credits
fact-pays-paid = all paid
fact-pays-left = up to { $left } cr more for a better score
fact-opens = opens
fact-drones = drones
fact-drones-are = { $count }; your licence is for { $licence }
fact-daily = today
fact-daily-open = seed of the day not flown yet
fact-daily-flown = seed of the day flown; repeats are practice

# The list of profiles.
profiles-title = profiles
profiles-now = (now)
profiles-new = new profile ...
profiles-guest = Guest (results are not kept)
profiles-keys = { $scroll } move   { $submit } choose   { $escape } back
profiles-in-flight = a mission is under way: end it first; its result belongs to the current profile
profiles-nameless = type a name
prompt-profile = your name
prompt-profile-advice = your flights, credits and designs are stored on this machine only
prompt-seed = seed for practice
prompt-seed-advice = a number; the same seed gives the same layout. For the seed from `--seed` (default 1), just press { $submit }. Practice earns nothing

# Own progress.
standing-no-profile = Guests have no progress. Press { $key } to choose or create a profile; then this room shows skills, scores, credits and experience over time.
standing-choose-first = choose a profile first, with { $key }
standing-skill-locked = no open mission trains { $skill }: { $why }
standing-skill-untrained = no mission of the course trains { $skill }
standing-level = level { $level }
standing-experience = experience { $experience }/{ $needed }
standing-credits = { $credits } cr
standing-licence = licence { $count }
standing-flights = { $count ->
    [one] { $count } flight
   *[other] { $count } flights
}
standing-aids-key = changes it
standing-skills = skills: probability of mastery
standing-next = next
standing-review = review { $when }
standing-why = why: { $skill }
standing-lacks = for mastery: { $lacks }
standing-why-nothing = no evidence yet: fly a mission that trains it
standing-moved = { $mission }: { $what } { $percent } %, { $when }
standing-scores = scores by mission
standing-scores-nothing = no flights yet
standing-column-mission = mission
standing-column-flights = flights
standing-column-best = best
standing-column-medal = medal
standing-column-last = last
standing-column-when = when
standing-chart = points, flight by flight: { $mission }   x not passed   p practice
standing-wealth = credits and experience after each flight and purchase
standing-wealth-nothing = no flights yet
standing-curve = { $what }: { $now } now
standing-curve-credits = credits
standing-curve-experience = experience
days-today = today
days-ahead = in { $count } d
days-ago = { $count } d ago

# How much advice the console gives automatically.
aids-full-about = advice: full; every hint and all feedback
aids-fading-about = advice: fading; fewer hints as your skills grow
aids-none-about = advice: none; only hints on request

debrief-career = CAREER
