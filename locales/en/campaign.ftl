# The campaign: skills, locks, parts.
skill-arming = checks and arming
skill-commands = modes and commands
skill-navigation = flying to places
skill-energy = energy
skill-links = links and failsafes
skill-coverage = covering areas
skill-sensors = reading sensors
skill-threats = answering threats
skill-separation = separation and airspace
skill-swarm = tasking a swarm
skill-design = designing drones
skill-judgement = judging oneself
skill-prediction = the score that was predicted

locked-pass = pass { $mission }
locked-medal = win a { $medal } medal in { $mission }
locked-skill = { $skill }: { $has } %, { $wanted } % needed
locked-licence = needs a licence for { $wanted } drones, yours is for { $has }

buy-unknown = there is no such part; `sortie workshop parts` lists them
buy-owned = it is yours already
buy-locked = pass { $mission } first
buy-too-dear = it costs { $price } credits, there are { $credits }

reward-heading = Career
reward-credits = credits +{ $pay }, { $now } now
reward-credits-wear = credits +{ $pay }, -{ $wear } for wear of your drones, { $now } now
reward-unpaid = no credits: { $why }; { $now } now
reward-unpaid-wear = no credits: { $why }; -{ $wear } for wear of your drones, { $now } now
reward-practice = practice earns none
reward-not-passed = the mission is not passed
reward-not-better = only a score above { $best } earns more
reward-daily-again = the seed of the day counts once a day
reward-no-pay = this flight earns none
reward-experience = experience +{ $gained }, level { $level }, { $left } to the next
reward-level = experience +{ $gained }, level { $before } -> { $after }, { $left } to the next
reward-licence = licence for { $before } -> { $after } drones
reward-mission = new mission: { $mission }
reward-parts = new parts on sale: { $parts }
reward-skill = { $skill } { $before } % -> { $after } %: { $why }
reward-seen = { $what } { $percent } %

profiles-unusable = the profiles cannot be kept in { $path }: { $error }
profiles-newer = { $path } was made by a newer version of sortie (tables of version { $found }, this one knows { $known }); nothing was changed. Use that version, or another folder with --data
profiles-database = { $path }: { $error }
profiles-unknown = there is no profile `{ $name }`; there are: { $known }
profiles-unknown-first = there is no profile `{ $name }`, nor any other; `sortie profile create { $name }` makes it
profiles-exists = there is a profile `{ $name }` already
profiles-name = a profile's name is one line of 1 to { $most } letters
profiles-no-profile = this is no profile: { $fault }
profiles-rescued = the profiles were damaged ({ $fault }) and were restored from { $copy }; the damaged file is { $damaged }
profiles-lost = the profiles were damaged ({ $fault }) and there is no copy: they begin anew; the damaged file is { $damaged }

mission-locked = { $mission } is locked: { $why }
career-nowhere = no profiles are kept here: the data folder cannot be used
career-waits = the flight is not stored yet: { $fault }; it is tried again before the next flight and at the end of the console
launch-practice = this flight is for practice: the mission is locked or none of the course, a part is not yours, or a seed, a frame or a speed was chosen
flight-practice = { $mission }, practice
flight-daily = { $mission }, seed of the day
flight-exam = { $mission }, exam
