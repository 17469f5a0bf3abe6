# The hangar: ArduPilot SITL processes.

hangar-unknown = there is no instance { $id }
hangar-taken = instance { $id } is there already: stop it first, or choose another number
hangar-full = { $limit } instances run, and no more may: stop some, or raise the limit
hangar-no-program = no { $program } was found: name one with --arducopter or SORTIE_ARDUCOPTER, or put it on the PATH
hangar-attached = somebody is attached to instance { $id } already
hangar-host = cannot start instance { $id }: { $what }: { $error }
hangar-closing = the hangar is closing
hangar-cannot-open = cannot open the hangar in { $folder }: { $error }
hangar-no-service = no hangar service can be reached at { $urls } yet
