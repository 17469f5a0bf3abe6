## Exams: files, the desk, the seat, seals.

# The file of an exam.
exam-schema = unknown schema { $found }: this version reads schema { $known }
exam-layout = the layout is “own” or “same”, not “{ $word }”
exam-time = a date, a time and an offset from UTC are needed: 2026-12-01T09:00:00+02:00
exam-window = the exam would close before it opens
exam-missions = { $count ->
    [one] { $count } mission: an exam has 1 to { $most }
   *[other] { $count } missions: an exam has 1 to { $most }
}
exam-no-mission = no mission of the course is called “{ $name }”
exam-no-mission-help = only missions of the course can be exams: a mission of your own would only be practice at the seats
exam-mission-twice = “{ $name }” is in the exam already: give it more tries instead
exam-number = `{ $key }` is a number from 1 to { $most }, not { $found }

exams-title = Exams
argument-exam-name = the name of an exam, or its file

# The desk.
class-exam-begun = exam “{ $exam }” begun: { $seats }
class-exam-unread = exam “{ $exam }”: { $fault }
class-exam-other = the exam “{ $exam }” is going on; end it first: class exam stop
class-exam-none = no exam is under way
class-exam-found = the exam “{ $exam }” continues
class-exam-found-ended = the exam “{ $exam }” has ended, so no more tries are opened; those under way are still watched: { $seats }
class-exam-ask-begin = BEGIN the exam “{ $exam }” with { $count } of { $here ->
    [one] { $here } connected seat
   *[other] { $here } connected seats
}: { $seats }
class-exam-ask-begin-reason = their first tries open as soon as the exam is open; a try that has opened is used up
class-exam-ask-end = End the exam “{ $exam }” of { $began } UTC?
class-exam-ask-end-reason = the exam is still open; it continues unless you end it
class-exam-ask-quit-reason = the exam “{ $exam }” ends: no more tries are opened; those under way go on, and a desk that is opened again watches them
class-exam-found-other = an earlier exam, “{ $exam }”, has not ended, but “{ $held }” is under way; to continue “{ $exam }”, end “{ $held }” and open the desk again
class-exam-stopped = exam “{ $exam }” ended: no more tries are opened, and flights go on
class-exam-failed = notes or results of the exam cannot be written; the desk tries again every minute: { $fault }
class-exam-no-folder = an exam needs a data folder for its notes and records: set HOME, or name one with `--data`
class-exam-no-random = the system has no random numbers for the seeds
class-column-exam = exam
class-exam-cell-waits = waits
class-exam-cell-opens = opens
class-exam-cell-done = done
class-exam-cell-closed = closed
class-key-exam = hold an exam
class-deed-try = exam { $mission }, try { $number } of { $tries }
class-refusal-flown = this try is used up already
class-exam-unrecorded = the try of the exam was not opened: this console keeps no complete records (`--no-record`, `records.enabled`, or ArduPilot as simulator)
class-refusal-practice = the flight would only be practice: own mission files, own airframes, another speed, or it could not begin

# The seat.
class-exam-no-restart = a try of an exam cannot be restarted
class-exam-no-leave = the class cannot be left during a try of an exam: end the flight first
class-exam-ask-leave = this uses up the try of the exam: the desk does not open it again
class-exam-ask-end-try = this ends the try of the exam: it does not count and has no result, and it is used up
class-exam-time-up = the time of this try is up

# Seals.
seal-none = there is no seal yet
seal-unreadable = it cannot be read: { $error }
seal-damaged = it is not a seal
seal-unsigned = it has no signature
seal-signature = its signature does not fit: the seal was changed, or signed with another key
seal-other-key = it was made with another key than the expected one
seal-other-record = it is the seal of the record { $record }
seal-other-user = it is the seal of { $user }
seal-other-class = it is the seal of the class { $class }
seal-other-result = flown again, the flight has another result
seal-not-sealed = { $file } is not in it: the file was added afterwards
seal-changed = { $file } is not the file that was sealed
seal-missing = { $file } is missing
seal-bad = The seal is not valid: { $fault }.
seal-of = Seal of class { $class }, exam { $exam }: { $user }, { $mission }, try { $number } of { $tries }, { $score } { $score ->
    [one] point
   *[other] points
}.
seal-counts = The try counts.
seal-key-not-compared = Signed, key not compared: the try counts if the key is that of the desk.
seal-counts-not = The try does not count: { $reasons }.
seal-reason-no-exam = it was not flown as an exam
seal-reason-script = a script gave the commands
seal-reason-mission = the mission is not that of the course
seal-reason-fleet = it was flown with designs of the trainee
seal-reason-paused = the flight was paused, or its console was stopped
seal-reason-no-inputs = the record has no inputs, so it cannot be flown again
seal-reason-late = it went on after its time
seal-reason-unseen = the desk saw nothing of it while it was flown
seal-reason-rewritten = the record is not the one that the desk saw being written
witness-whole = Witnessed: the desk saw the record grow, { $heads ->
    [one] { $heads } time
   *[other] { $heads } times
}, without gaps.
witness-part = Witnessed in part: the desk saw the record grow, { $heads ->
    [one] { $heads } time
   *[other] { $heads } times
}; the longest gap was { $gap }.
witness-stopped = Witnessed, but the mission's time stood still for { $stopped }: the desk saw the record grow, { $heads ->
    [one] { $heads } time
   *[other] { $heads } times
}.
witness-unseen = Not witnessed.
witness-other = The desk saw another record being written: { $record }.
witness-rewritten = Rewritten: the first { $bytes } bytes are not those that the desk saw.
seal-key-known = Key of this desk: { $key }
seal-key-other = Another key: { $key }
seal-key-unknown = Key: { $key } (not compared: name the desk's key with --public-key)

# Reports.
class-report-exams = Exams
class-report-exam = exam
class-report-try = try
class-report-seal = seal
class-report-no-record = no record was handed in
class-report-try-left = left: no record was handed in
class-report-try-open = still open
class-report-witness = witness
class-report-score = score
class-key-public = Public key of this desk: { $key }
class-key-fingerprint = Fingerprint: { $fingerprint }
class-key-none = this desk has no key yet: it is made when the first try is sealed

# Ends of records, and damaged notes.
seal-reason-left = the flight was left, or its console ended, before the mission was over
seal-reason-end-unseen = the desk did not see the end of the record
seal-reason-no-checksum = the end of the record has no checksum
exam-notes-unreadable = { $file }: the notes of this exam cannot be read, so it is not continued: { $why }
exam-notes-damaged = { $file }, line { $line }: this note is damaged, so the exam is not continued: { $why }
exam-notes-no-begin = the exam does not begin with it
exam-notes-plan = the file of the exam in it does not fit this version of the course
exam-notes-time = its time cannot be right
