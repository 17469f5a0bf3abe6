### Що кілька апаратів роблять разом.

swarm-usual-spacing = { $metres } m між лініями, бо іншого не сказано
swarm-gaps = { $metres } м ліній лежать поза ділянкою, над її розривами
swarm-swath-spacing = { $metres } m між лініями, на ширину огляду датчика
swarm-staggered = кожен другий апарат летить на { $metres } m вище, бо лінії надто близькі
swarm-no-line = йому не лишилося лінії: ліній { $lines }, апаратів { $vehicles }
swarm-no-area = тут немає площі для обльоту
swarm-too-many-lines = на це треба понад { $most } ліній: візьміть меншу площу або більший крок
swarm-too-near = { $spacing } m надто близько: треба щонайменше { $least } m, щоб зберегти інтервал { $separation } m із запасом
swarm-no-way = безпечного шляху немає: дехто над іншими; спершу дайте `spread`
swarm-no-home = жоден апарат не сказав, де дім
swarm-not-there = апарат { $vehicle } не сказав, де він
swarm-its-own-goal = він не може летіти сам за собою
swarm-no-formation = він не в строю
swarm-goes-along = у строю апарата { $leader }
swarm-falls-out = випадає з { $verb }: { $reason }
swarm-waits = чекає ({ $verb }): на його шляху { $other }
swarm-lost = його більше не чути
swarm-does-not-fly = він більше не летить
