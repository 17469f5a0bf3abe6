### Що кілька апаратів роблять разом.

swarm-usual-spacing = { $metres } m між лініями (типово)
swarm-gaps = { $metres } m ліній лежать поза ділянкою, над її розривами
swarm-swath-spacing = { $metres } m між лініями, на ширину огляду датчика
swarm-staggered = кожен другий апарат летить на { $metres } m вище, бо лінії надто близькі
swarm-no-line = йому не лишилося лінії: ліній { $lines }, апаратів { $vehicles }
swarm-no-area = тут немає площі для обльоту
swarm-too-many-lines = на це треба понад { $most } ліній: візьміть меншу площу або більший крок
swarm-too-near = { $spacing } m надто близько: треба щонайменше { $least } m, щоб зберегти інтервал { $separation } m із запасом
swarm-no-way = безпечного шляху немає: деякі апарати над іншими; спершу дайте `spread`
swarm-no-home = місце дому ще невідоме
swarm-not-there = місце апарата { $vehicle } ще невідоме
swarm-its-own-goal = він не може летіти сам за собою
swarm-no-formation = він не в строю
swarm-goes-along = у строю апарата { $leader }
swarm-falls-out = виходить із { $verb }: { $reason }
swarm-waits = чекає ({ $verb }), доки { $other } звільнить шлях
swarm-lost = зв'язку з ним більше немає
swarm-does-not-fly = він більше не летить
