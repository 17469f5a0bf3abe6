# The hangar: ArduPilot SITL processes.

hangar-unknown = no instance { $id }
hangar-taken = instance { $id } is already running: stop it first, or choose another number
hangar-full = { $limit } instances are running, which is the limit: stop some, or raise the limit
hangar-no-program = no { $program } was found: name one with `--arducopter` or `SORTIE_ARDUCOPTER`, or put it on the PATH
hangar-attached = another program is attached to instance { $id }: close that program, or choose another instance
hangar-host = cannot start instance { $id }: { $what }: { $error }
hangar-closing = the hangar is closing
hangar-cannot-open = cannot open the hangar in { $folder }: { $error }

hangar-none = No processes simulate these vehicles. `sortie fly --backend ardupilot` starts ArduPilot SITL for each vehicle; this room then shows the processes.
hangar-opening = opening the hangar ...
hangar-ready = { $ready } of { $count } ready
hangar-host-title = host
hangar-stage = stage
hangar-pid = pid
hangar-restarts = starts
hangar-memory = memory
hangar-processor = CPU
hangar-stage-queued = queued
hangar-stage-process = running
hangar-stage-heartbeat = heartbeat
hangar-stage-fetching = parameters { $received }/{ $count }
hangar-stage-parameters = needs a position
hangar-stage-position = position, last checks
hangar-stage-ready = ready
hangar-stage-stopping = stopping
hangar-stage-crashed = CRASHED
hangar-stage-ended = ended
hangar-vehicle = vehicle { $vehicle }
hangar-fault = CRASHED: { $reason }
hangar-fault-what = { $restart } restarts the vehicle on its pad. { $stop } stops its process for good.
hangar-no-output = in { $folder }; nothing printed yet
hangar-output = in { $folder }; last output:
hangar-output-of = vehicle { $vehicle }: output
hangar-key-output = output
hangar-key-restart = restart
hangar-key-stop = stop
hangar-key-leave = leave
hangar-all-ready = { $count ->
    [one] the vehicle is ready to arm
   *[other] all { $count } vehicles are ready to arm
}
hangar-ready-again = is ready to arm again
hangar-restarted = its process was restarted (restart { $count })
hangar-crash = its process is gone: { $reason }
hangar-crash-said = its process is gone: { $reason }; it last said: { $line }
hangar-crash-again = { $key }, then { $again } restarts it (`hangar restart { $vehicle }`)
hangar-no-process = no process of vehicle { $vehicle }
hangar-ask-armed = it is armed; if it is flying, it will crash
hangar-ask-restart = RESTART vehicle { $vehicle }
hangar-ask-stop = STOP the process of vehicle { $vehicle }
hangar-restarting = restarting vehicle { $vehicle }
hangar-stopping = stopping the process of vehicle { $vehicle }
hangar-not-begun = the mission begins when all vehicles are ready: { $key } shows their progress
hangar-failed = the vehicles could not be started: { $reason }
hangar-plain-stages = starting: { $stages }
hangar-plain-stage = { $vehicles } { $stage }
hangar-plain-given-up = the vehicles did not start: the flight ends here
hangar-plain-none = no processes simulate these vehicles
hangar-here = here

# Hangars on other machines.

hangar-far = hangar { $hangar }: { $error }
hangar-far-unreachable = { $address } cannot be reached ({ $error }): is `sortie hangar` running there? For a hangar on another host, forward its port: `ssh -L PORT:127.0.0.1:PORT HOST`
hangar-far-late = { $address } did not answer within { $seconds } s: check that host and the network
hangar-far-other = { $address } answers, but it is not a sortie hangar ({ $error }): check the address
hangar-far-token = { $address } requires a token ({ $error }): copy its token file to this machine and add `--hangar-token FILE`
