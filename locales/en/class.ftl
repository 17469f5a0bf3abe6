# A class: the instructor's desk and the trainees' seats

class-no-socket = { $socket } exists and is not a socket: choose another name
class-in-use = a desk is already open at { $socket }: choose another name, or close it
class-not-open = cannot open { $socket }: { $error }
class-folder = { $folder } belongs to another user, or others may change it: choose another name
class-stranger = not joined: the desk at { $socket } belongs to { $user }, not to { $instructor }
