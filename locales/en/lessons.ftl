# Lesson plans: the faults in their files, and what the desk shows

# Faults
lesson-schema = unknown schema { $found }: this version reads schema { $known }
lesson-english-only = in English only: add a Ukrainian text next to each English one, such as `title_uk` next to `title`
lesson-text-empty = the text is empty
lesson-steps = { $count } steps: a lesson has at least one and at most { $most }
lesson-id = `{ $name }` is no name for a step: use letters, digits, `-` and `_`, at most { $most } of them, and not `end`
lesson-id-twice = a step before is called `{ $name }` too
lesson-no-step = there is no step `{ $name }`
lesson-known-steps = the steps are: { $known }
lesson-no-flight = no mission is flown before this step, so there is nothing to wait for
lesson-no-flight-help = put `fly MISSION` into a step before, or wait for the instructor with `when = "manual"`
lesson-condition-long = a condition in a lesson is at most { $most } characters long
lesson-when = `{ $word }` is neither `manual`, `started`, `over` or `passed` nor a condition
lesson-limit = `within` is 1 to { $most } seconds, not { $found }
lesson-limit-at-once = a step that starts at once needs no time limit: add `when`, or leave `within` and `otherwise` out
lesson-within-alone = `within` needs `otherwise`: the step that follows after this time, or `end`
lesson-otherwise-alone = `otherwise` needs `within`: after how many seconds it follows
lesson-message-alone = `message_uk` needs `message`
lesson-message-long = a message is at most { $most } characters long
lesson-order-none = not an order to a seat: use `message`, `hint`, `mark`, `freeze`, `resume`, `inject`, `disarm`, `fly`, `start` or `end`
lesson-order-seat = an order of a lesson goes to the seats of the lesson: leave the name after `@` out
lesson-exam = not permitted in exams: only `message`, `start` and `end` are
lesson-exam-help = the last `fly` before it has `exam`
lesson-no-mission = there is no mission `{ $name }`; the missions are: { $known }
lesson-inject-no-flight = no mission is flown yet: put `fly MISSION` before the inject
lesson-inject = the mission { $mission } does not permit the inject `{ $name }`; it permits: { $known }
lesson-inject-none = the mission { $mission } permits no injects
lesson-unreached = nothing leads to the step `{ $name }`: name it in `then` or `otherwise` of another one, or remove it
lesson-endless = nothing leads from the step `{ $name }` to the end of the lesson: let a step that follows it have `then = "end"`
lesson-circle = the steps go round from `{ $name }` to `{ $name }` without waiting: give one of them a `when`

# The desk
class-lesson-begun = lesson “{ $lesson }” begun: { $seats }
class-lesson-next = next step of the lesson: { $seats }
class-lesson-skip = step skipped: { $seats }
class-lesson-back = one step back: { $seats }
class-lesson-stop = lesson ended: { $seats }
class-lesson-none = { $seats }: no lesson is going on; begin one with `class lesson NAME`
class-lesson-not-waiting = { $seats }: the step is being carried out, or the lesson has ended
class-lesson-first = { $seats }: this is the first step
class-lesson-unread = the lesson { $lesson } cannot be read: { $fault }
class-lesson-resumed = lesson “{ $lesson }” continues where each seat was
class-lessons-title = lessons: begin one with `class lesson NAME`
class-lesson-named = { $name }: { $title }. { $about }
class-lesson-faulty = { $name } has faults and cannot be begun: `sortie check { $file }` shows them
class-lesson-has-faults = has faults
class-lessons-none = there are no lessons
class-lessons-reading = The lessons are being read.
class-lesson-title = { $seat }: { $lesson }, step { $number } of { $count }: { $step }
class-lesson-wait-seat = waits for the answer of the seat
class-lesson-wait-manual = waits for you: { $key } continues
class-lesson-wait-back = you have gone back to this step: { $key } lets it begin
class-lesson-wait-not-flown = the mission was not begun at the seat: { $key } tries again, and leads on
class-lesson-wait-refused = the seat cannot watch the condition: { $key } continues
class-lesson-wait-circles = the lesson repeats its steps without end: { $key } continues
class-lesson-wait-condition = waits for: { $when }
class-lesson-wait-others = waits for the other seats
class-lesson-wait-limit = { $wait }; if not within { $time }: { $step }
class-lesson-wait-ended = the lesson has ended
class-lesson-end = the end
class-lesson-does = does: { $deeds }
class-lesson-then = then: { $step }
class-column-lesson = lesson
class-key-lesson = lesson
class-key-next-step = next step
class-key-step-back = step back
argument-lesson = the name of a lesson, or its file
argument-exam = as an exam
lessons-title = Lessons, for `class lesson NAME` at the desk:
