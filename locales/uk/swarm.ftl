### Що кілька апаратів роблять разом.

swarm-usual-spacing = { $metres } m між лініями (типово)
swarm-gaps = { $metres } m ліній перетинають розриви ділянки
swarm-swath-spacing = { $metres } m між лініями: ширина смуги датчика
swarm-staggered = кожен другий апарат летить на { $metres } m вище, бо лінії близько одна від одної: перевірте, чи датчик працює на цій висоті
swarm-no-line = апарату не лишилося лінії: ліній { $lines }, апаратів { $vehicles }
swarm-one-place = { $vehicles } летять в одне місце на одній висоті й там зійдуться: дайте команду `formation` або кожному свою висоту (`up`)
swarm-one-place-planes = { $vehicles } летять в одне місце на одній висоті й там зійдуться: дайте кожному своє місце або свою висоту (`up`)
swarm-no-area = немає ділянки для обльоту
swarm-too-many-lines = на це треба понад { $most } ліній: виберіть меншу ділянку або більшу відстань між лініями
swarm-too-near = { $spacing } m надто близько: треба щонайменше { $least } m, щоб зберегти дистанцію { $separation } m із запасом
swarm-no-way = безпечного шляху немає: деякі апарати над іншими; спершу дайте `spread`
swarm-no-home = позиція дому ще невідома
swarm-not-there = позиція апарата { $vehicle } ще невідома
swarm-its-own-goal = апарат не може летіти сам за собою
swarm-no-formation = апарат не в строю
swarm-goes-along = рухається в строю апарата { $leader }
swarm-leads = веде стрій
swarm-falls-out = виходить із { $verb }: { $reason }
swarm-waits = чекає ({ $verb }), доки { $other } звільнить шлях
swarm-lost = зв'язок втрачено
swarm-does-not-fly = апарат більше не летить
