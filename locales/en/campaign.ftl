# The campaign: skills, locks, parts.
skill-arming = checks and arming
skill-commands = modes and commands
skill-navigation = flying to places
skill-energy = energy
skill-links = links and failsafes
skill-coverage = covering areas
skill-sensors = reading sensors
skill-threats = answering threats
skill-separation = separation and airspace
skill-swarm = tasking a swarm
skill-design = designing drones
skill-judgement = judging oneself
skill-prediction = the score that was predicted

locked-pass = pass { $mission }
locked-medal = win a { $medal } medal in { $mission }
locked-skill = { $skill }: { $has } %, { $wanted } % needed
locked-licence = needs a licence for { $wanted } drones, yours is for { $has }

buy-unknown = there is no such part
buy-owned = it is yours already
buy-locked = pass { $mission } first
buy-too-dear = it costs { $price } credits, there are { $credits }
