# Errors of a vehicle's files (MAVFTP).
ftp-fail = the vehicle refuses the request without giving a reason
ftp-system = error { $number } of the vehicle's file system
ftp-invalid-size = the vehicle rejects the size of the request
ftp-invalid-session = another ground station has a file open
ftp-no-session = the vehicle has no free session
ftp-end-of-file = the file ended early
ftp-unknown-command = the vehicle does not know this request
ftp-exists = the file already exists
ftp-protected = the file is write-protected
ftp-not-found = file not found
ftp-other = refused with the unknown code { $code }
ftp-silent = no answer
ftp-other-size = the file has a different size, { $bytes } bytes
ftp-malformed = malformed answer
ftp-too-many = the folder has too many entries
ftp-bad-path = the path is empty or too long
