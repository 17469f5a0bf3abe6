# Parameters: the room, files, and faults of values.

action-changed-parameters = show only parameters changed or in the file
action-save-parameters = save the parameters to a file
action-load-parameters = load a file and show the differences
action-compare-parameters = compare with a file or another vehicle
action-apply-parameters = set the marked parameters
action-fetch-parameters = read all parameters from the vehicle again
action-read-documents = read the vehicle's parameter documentation

parameters-not-finite = not sent: { $name } accepts only finite numbers
parameters-not-whole = not sent: { $name } accepts only whole numbers ({ $kind })
parameters-out-of-range = not sent: { $name } accepts only { $least } to { $greatest } ({ $kind })
parameters-inexact = not sent: { $name } cannot be set to exactly that value; MAVLink would send { $nearest }
parameters-no-number = `{ $value }` is not a number

parameters-file-twice = { $name } is already set to { $value } on line { $line }
parameters-file-no-value = { $name } has no value
parameters-file-more = unexpected text after the value
parameters-file-name = `{ $name }` is not a parameter: names have 1 to 16 letters, digits and `_`
parameters-file-too-large = { $value } is too large for a vehicle
parameters-file-help = write `NAME,VALUE` on a line, and comments after a `#`
parameters-file-faulty = { $path }:{ $line }:{ $column }: { $fault } { $count ->
    [one] (nothing was loaded)
   *[other] ({ $count } faults in all; nothing was loaded)
}

parameters-title = vehicle { $vehicle }
parameters-title-compared = vehicle { $vehicle } and { $other }
parameters-of-vehicle = vehicle { $vehicle }
parameters-on = { $count ->
    [1] vehicle { $vehicles }
   *[other] vehicles { $vehicles }
}
parameters-no-vehicle = No vehicle yet: this room shows the parameters of vehicles in contact.
parameters-asking = requesting the vehicle's parameters ...
parameters-recorded = { $received } of { $count } recorded up to this moment
parameters-coming = { $received } of { $count }
parameters-repeating = { $received } of { $count }; no answer, requested again ({ $tries })
parameters-link-lost = { $received } of { $count }; link lost: continues when it is back
parameters-stalled = { $received } of { $count } received, then no answer: { $key } requests them again
parameters-complete = { $count ->
    [one] { $count } parameter
   *[other] { $count } parameters
}
parameters-marked = { $count } differ, { $marked } marked
parameters-hidden = { $count } only on this vehicle (o)
parameters-filter = /{ $filter }: { $count }
parameters-only-changed = only changed
parameters-other-than-default = only non-default
parameters-setting = setting: { $count } left
parameters-sets-on = targets: { $vehicles }
parameters-none-yet = nothing received yet
parameters-none-fit = no parameter matches: { $key } shows all
parameters-none-differ-yet = no differences so far
parameters-none-differ = no differences: { $key } shows all
parameters-none-changed = no changes: { $key } shows all
parameters-all-default = all parameters have their defaults: { $key } shows all

parameters-column-name = NAME
parameters-column-value = VALUE
parameters-column-type = TYPE
parameters-column-before = BEFORE
parameters-column-other = OTHER
parameters-column-state = STATE

parameters-asked = { $value } { $state }
parameters-state-waiting = waiting
parameters-state-sent = sent
parameters-state-confirmed = confirmed
parameters-state-refused = refused
parameters-state-unanswered = no answer
parameters-state-replaced = superseded
parameters-differs = differs
parameters-own = this vehicle's own
parameters-missing = not on this vehicle
parameters-extra = only on this vehicle
parameters-changed = changed
parameters-default = default { $value }
parameters-before = was { $value }

parameters-set-done = { $failed ->
    [0] parameters set: { $confirmed } confirmed
   *[other] parameters set: { $confirmed } confirmed, { $failed } not: the list shows why
}
parameters-stopped = stopped: { $count } not set
parameters-nothing-compared = nothing to set: load a file (l) or compare (d) first
parameters-nothing-marked = no marked parameter can be set
parameters-ask-apply = SET { $count ->
    [one] { $count } parameter
   *[other] { $count } parameters
} on { $vehicles }
parameters-ask-apply-reason = each is sent as its own command; the list shows the outcomes
parameters-nothing-to-save = no parameters received yet
parameters-not-complete = vehicle { $vehicle } has sent { $received } of { $count } parameters: wait for the rest
parameters-no-path = enter a file name
parameters-same-vehicle = vehicle { $vehicle } is already shown: name another
parameters-no-such-vehicle = no vehicle { $vehicle }
parameters-saved = saved to { $path }
parameters-ask-replace = REPLACE { $path }
parameters-ask-replace-reason = a file with this name already exists

prompt-filter-advice = all words must match; { $submit } or { $escape } goes back to the list
prompt-parameter = { $name } on { $vehicles }
prompt-parameter-advice = { $submit } sets it, { $escape } leaves it unchanged
prompt-save-parameters = save parameters to
prompt-save-advice = a path (`~/` is your home folder); sortie asks before it replaces a file
prompt-load-parameters = load parameters from
prompt-load-advice = shows the differences before anything is set
prompt-compare-parameters = compare with
prompt-compare-advice = a file, or the number of another vehicle

parameters-hint-set = set
parameters-hint-search = search
parameters-hint-changed = changed
parameters-hint-save = save
parameters-hint-load = load
parameters-hint-compare = compare
parameters-hint-vehicle = vehicle
parameters-hint-help = help
parameters-hint-mark = mark
parameters-hint-mark-all = all, invert
parameters-hint-extra = only here
parameters-hint-apply = set the marked ones
parameters-hint-close = back

documentation-unknown = not a file with the documentation of parameters
documentation-unknown-help = `apm.pdef.xml` and `apm.pdef.json` of ArduPilot and `parameters.json` of PX4 are read
documentation-nothing = the file documents no parameters
documentation-cut-off = the file is cut off: elements are not closed
documentation-xml = the XML has a fault: { $fault }
documentation-json = the JSON has a fault: { $fault }
documentation-no-range = `{ $written }` is not a range: it has a lower and an upper limit
documentation-no-bit = `{ $written }` is not the number of a bit (0 to 31)
documentation-range = { $least } to { $most }
documentation-least = at least { $least }
documentation-most = at most { $most }
documentation-step = step { $step }
documentation-reboot = takes effect after a reboot
documentation-values = values: { $values }
documentation-bits = bits: { $bits }
documentation-outside = { $name } = { $value } is outside its documented range: { $range }
documentation-not-listed = { $name } = { $value } is not one of its documented values
documentation-unknown-bits = { $name } = { $value } has bits without a documented meaning
documentation-still = { $doubt }; { $submit } sets it anyway
parameters-column-meaning = UNIT, MEANING

# What a vehicle documents about itself (`param docs`).
metadata-parameters = { $count ->
    [one] { $count } parameter documented
   *[other] { $count } parameters documented
}
metadata-events = { $count ->
    [one] { $count } event text
   *[other] { $count } event texts
}
metadata-no-parameters = no documentation of parameters: { $fault }
metadata-no-events = no event texts: { $fault }
metadata-elsewhere = the file is not on the autopilot; get { $address } and name it with --parameter-docs or --event-docs
metadata-nothing = it names no files about parameters or events
metadata-damaged = the compressed file is damaged ({ $fault })
metadata-too-large = the file is larger than { $most } MB
metadata-not-text = the file is not a text
events-version = version { $version } of the format; version 2 can be read
events-nothing = the file has no event
events-fault = event { $event }: { $fault }
events-no-number = { $written } is not the number of an event
outcome-metadata-none = the vehicle names no documentation of its own (COMPONENT_METADATA); --parameter-docs names a file
refused-metadata-busy = the vehicle's documentation is already being read
