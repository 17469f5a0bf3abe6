# The interface for programs

api-no-json = the line is not JSON: { $error }
api-no-object = the line is not a JSON object
api-bad-id = `id` must be a whole number, 0 or more
api-bad-request = the request is invalid: { $error }
api-bad-interval = `every_s` must be between { $least } and { $most }
api-which-vehicle = name the vehicle: `"vehicle": 1`
api-too-long = the line is longer than { $most } bytes
api-not-utf8 = the line is not UTF-8
api-read-only = this socket is read-only: start the console with `--api` to give commands
api-crowded = { $most } programs are connected, and there is no place for another: close one of them
api-exam = programs cannot give commands in an exam
api-screen = only a user at the console can give this command
api-no-macro = macros are not available to programs: send their lines one by one
api-asks = this command needs a confirmation: send it again with `"confirm": true`
api-commands = a program is giving commands through { $socket }
api-in-use = { $socket } is in use by another console: choose another path
api-no-socket = { $socket } exists and is not a socket: choose another path, or remove the file
api-not-open = cannot open the socket { $socket }: { $error }
