# The hangar: ArduPilot SITL processes.

hangar-unknown = there is no instance { $id }
hangar-taken = instance { $id } is there already: stop it first, or choose another number
hangar-full = { $limit } instances run, and no more may: stop some, or raise the limit
hangar-no-program = no { $program } was found: name one with --arducopter or SORTIE_ARDUCOPTER, or put it on the PATH
hangar-attached = somebody is attached to instance { $id } already
hangar-host = cannot start instance { $id }: { $what }: { $error }
hangar-closing = the hangar is closing

# Hangars that are services elsewhere.

hangar-far = hangar { $hangar }: { $error }
hangar-far-unreachable = { $address } cannot be reached ({ $error }): is `sortie hangar` running there? From another host: `ssh -L PORT:127.0.0.1:PORT HOST`
hangar-far-late = { $address } has not answered within { $seconds } s
hangar-far-other = { $address } answers, but it is no sortie hangar ({ $error })
hangar-far-token = { $address } wants its token ({ $error }): copy its token file here and name it with --hangar-token FILE
