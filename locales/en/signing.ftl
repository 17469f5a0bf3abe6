# MAVLink signing: keys, and the outcomes of `signing`.

signing-file-error = signing keys are not used: { $path }: { $error }
signing-file-readable = signing keys are not used: others can read { $path } (mode { $mode }); run `chmod 600 { $path }`, and give the vehicles new keys with `signing rotate`
signing-file-foreign = signing keys are not used: { $path } belongs to another user
signing-file-in-use = signing keys are not used: another console uses { $path }; close it and start again
signing-file-content = signing keys are not used: { $path }: { $fault }
signing-file-fault = fault in line { $line }
signing-no-folder = signing keys need a data folder: set HOME, or name one with `--data`
signing-no-random = the system provides no random numbers for a key: { $error }

refused-signing-here = keys are for vehicles on sockets and serial ports, not for the embedded simulator or recordings
refused-signing-armed = it is armed: keys change only on the ground, disarmed
refused-signing-busy = another change of its key is under way
refused-signing-foreign = it signs with a key that sortie does not have: copy its key into `signing.toml`, or run `signing setup` over USB
refused-signing-has-key = it signs already: `signing rotate` gives it a new key
refused-signing-without-key = it does not sign: `signing setup` gives it a key
refused-signing-required = with `--require-signing` (`connect.require_signing`), sortie ignores vehicles that do not sign, so this one would be lost: restart sortie without it, then remove the key

outcome-signing-set-up = signs now, proved by a signed answer
outcome-signing-rotated = signs with a new key, proved by a signed answer; the old key is deleted
outcome-signing-removed = no longer signs; its key stays in the file, unused
outcome-signing-refused = the vehicle did not accept the key: { $reason }
outcome-signing-not-taken = no frame shows the change after { $tries } attempts; the earlier state stays, and both keys are kept
outcome-signing-reverted = the change shows, but there was no proof within { $seconds } s: the earlier key was sent again, and both keys are kept

hazard-signing-setup = gives each vehicle a key; the key crosses the link in clear text
hazard-signing-rotate = gives each vehicle a new key and deletes the old one; the key crosses the link in clear text
hazard-signing-remove = lets the vehicles obey unsigned frames from anyone again
