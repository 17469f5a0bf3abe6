# Why something about a vehicle's files (MAVFTP) fails.
ftp-fail = the vehicle refuses it without a reason
ftp-system = error { $number } of the vehicle's file system
ftp-invalid-size = the vehicle finds the size of the request invalid
ftp-invalid-session = another ground station has a file open
ftp-no-session = the vehicle has no free session
ftp-end-of-file = the file ended early
ftp-unknown-command = the vehicle does not know this request
ftp-exists = the file exists already
ftp-protected = the file is write-protected
ftp-not-found = file not found
ftp-other = refused with the unknown code { $code }
ftp-silent = no answer
ftp-other-size = the file has another size, { $bytes } bytes
ftp-malformed = an answer made no sense
ftp-too-many = the folder has too many entries
ftp-bad-path = the path is empty or too long
