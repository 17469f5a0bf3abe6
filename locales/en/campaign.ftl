# The campaign: skills, locks, parts.
skill-arming = checks and arming
skill-commands = modes and commands
skill-navigation = flying to places
skill-energy = energy
skill-links = links and failsafes
skill-coverage = covering areas
skill-sensors = reading sensors
skill-threats = responding to threats
skill-separation = separation and airspace
skill-swarm = tasking a swarm
skill-design = designing drones
skill-judgement = self-assessment
skill-plans = making and checking plans
skill-prediction = predicting the score

locked-pass = pass { $mission }
locked-medal = win a { $medal } medal in { $mission }
locked-skill = { $skill } { $has } %, needs { $wanted } %
locked-licence = needs a licence for { $wanted } drones; yours is for { $has }

buy-unknown = unknown part; `sortie workshop parts` lists all parts
buy-owned = you already own this part
buy-locked = pass { $mission } first
buy-too-dear = costs { $price } credits; you have { $credits }

reward-heading = Career
reward-exam-passed = EXAM PASSED
reward-exam-failed = EXAM NOT PASSED
reward-credits = credits +{ $pay }, { $now } now
reward-credits-wear = credits +{ $pay }, -{ $wear } for wear and damage to your vehicles, { $now } now
reward-unpaid = no credits: { $why }; { $now } now
reward-unpaid-wear = no credits: { $why }; -{ $wear } for wear and damage to your vehicles, { $now } now
reward-practice = practice earns none
reward-not-passed = the mission was not passed
reward-not-better = only a score above { $best } earns more
reward-all-points = your best score is { $best }, the highest possible
reward-daily-again = the seed of the day counts once a day
reward-no-pay = this flight earns none
reward-experience = experience +{ $gained }, level { $level }, { $left } to the next
reward-level = experience +{ $gained }, level { $before } -> { $after }, { $left } to the next
reward-licence = licence for { $before } -> { $after } drones
reward-mission = new mission: { $mission }
reward-parts = new parts on sale: { $parts }
reward-vehicle = new kind of vehicle: { $kind }; its parts are on sale in the workshop
vehicle-kinds = you can build: { $kinds }
vehicle-after = { $kind } (after mission { $mission })
reward-skill = { $skill } { $before } % -> { $after } %: { $why }
reward-skill-new = { $skill } { $after } %, first evidence: { $why }
reward-seen = { $what } { $percent } %

profiles-unusable = cannot store profiles in { $path }: { $error }
profiles-unreadable = cannot read the profiles in { $path }: { $error }
profiles-forbidden = { $path } belongs to { $owner }, who alone may read it: ask { $owner } for access
profiles-unshared = { $path } belongs to { $owner }, who alone may read it: the folder { $folder } has no setgid bit, so new results in it are not shared with its group; ask { $owner } to run `sortie doctor`, which prints the command
sharing-foreign = the group cannot read { $path }: it belongs to { $owner }, and only root can change that; `sortie doctor` prints the command
sharing-failed = the group cannot read { $path }: { $error }; `sortie doctor` prints the command
sharing-group-bit = new results in { $path } are not shared with its group: only root can set the setgid bit of this folder; `sortie doctor` prints the command
sharing-more = more files and folders that the group cannot read: { $count }; `sortie doctor` names them
profiles-read-only = { $path } can only be read: nothing is stored in its profiles; use a folder of your own with `--data`
profiles-newer = { $path } was made by a newer version of sortie (schema { $found }; this version reads { $known }); nothing was changed. Use that version, or another folder with `--data`
profiles-older = { $path } was made by an older version of sortie and is read-only here; its owner must start this version once to convert it
profiles-log-alone = { $path } is read-only here, and its last changes are in { $log }, which cannot be read in a read-only folder: copy both into a folder of your own, and name it with `--data`
profiles-database = { $path }: { $error }
profiles-unknown = no profile `{ $name }`; profiles: { $known }
profiles-unknown-first = no profile `{ $name }`; `sortie profile create { $name }` creates it
profiles-exists = the profile `{ $name }` already exists: choose another name
profiles-name = a profile's name is one line of 1 to { $most } characters
profiles-no-profile = not a profile: { $fault }
profiles-mended = { $count ->
    [one] 1 damaged row of the profiles was restored from the backup
   *[other] { $count } damaged rows of the profiles were restored from the backup
}
profiles-unmended = { $count ->
    [one] 1 row of the profiles is damaged, and no backup has it: its data cannot be read
   *[other] { $count } rows of the profiles are damaged, and no backup has them: their data cannot be read
}
profiles-rescued = the profiles were damaged ({ $fault }) and were restored from { $copy }; the damaged file is { $damaged }
profiles-fault-empty = the file is empty
profiles-fault-database = SQLite: { $words }
profiles-lost = the profiles were damaged ({ $fault }) and there was no backup, so they are empty now; the damaged file is { $damaged }

mission-locked = { $mission } is locked: { $why }
career-nowhere = no profiles here: the data folder cannot be used
career-waits = the flight is not stored yet: { $fault }; sortie tries again before the next flight and on exit
career-deferred = { $count ->
    [one] one flight could not be stored in its profile: its record is complete, and the next start of sortie stores it
   *[other] { $count } flights could not be stored in their profiles: their records are complete, and the next start of sortie stores them
}
career-ask-quit-reason = { $count ->
    [one] one flight is not stored yet, and would be lost
   *[other] { $count } flights are not stored yet, and would be lost
}
career-lost = { $count ->
    [one] one flight could not be stored, and is lost: make space on the disk before you fly again
   *[other] { $count } flights could not be stored, and are lost: make space on the disk before you fly again
}
launch-practice = practice only: { $why }
practice-seed = you chose the seed
practice-script = the commands come from a script
practice-own-mission = the mission is not part of the course, which contains only missions supplied by sortie or by the administrator
practice-altered-mission = the mission file differs from the course's mission with this id; to fly that mission, give your file another id, or remove it
practice-locked = the mission is locked ({ $why })
practice-parts = { $design } has parts that you do not own ({ $parts })
practice-airframes = the airframes are your own files
practice-slow = time runs slower than real time
practice-unconfirmed = the record cannot be confirmed (`sortie verify` gives the reason)
exam-real-time = an exam runs in real time: start sortie without `--speedup`
exam-alone = an exam is flown alone: start sortie without `--crew`
exam-by-hand = an exam is flown by hand, not by a script: start it from the home screen
daily-by-hand = a mission with the seed of the day is flown by hand, because a script would reveal the layout in advance: use `--seed N`
flight-practice = { $mission }, practice
flight-daily = { $mission }, seed of the day
flight-exam = { $mission }, exam
